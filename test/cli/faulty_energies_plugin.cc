// Energies that do everything that an energy may do wrong.
#include <ceres_ed/energy/custom_energy.h>
#include <ceres_ed/plugin/plugin_abi.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

namespace {

using ceres_ed::EnergyContext;
using ceres_ed::EnergyKind;
using ceres_ed::EnergyRegistry;
using ceres_ed::EnergyTerm;
using ceres_ed::ParameterValues;
using ceres_ed::ResidualSink;

// A residual on a point that `kWay` makes unusable.
enum class Way { kFails, kThrows, kNan, kNanDerivative, kNanOnceMoved };

template <Way kWay>
struct FaultyFunctor {
  static constexpr int kNumResiduals = 1;

  template <typename T>
  bool operator()(const T* point, T* residual) const {
    if (kWay == Way::kFails) return false;
    if (kWay == Way::kThrows) throw std::runtime_error("no coffee");
    residual[0] = point[0];
    if (kWay == Way::kNan) residual[0] = T(std::numeric_limits<double>::quiet_NaN());
    // The square root of zero, whose slope is infinite.
    if (kWay == Way::kNanDerivative) residual[0] = sqrt(T(0.0) * point[0]) + T(1.0);
    // Only where it has been first: it draws the point away, and is nothing there.
    if (kWay == Way::kNanOnceMoved)
      residual[0] = sqrt(T(1e-24) - (point[0] - x) * (point[0] - x)) + point[0];
    return true;
  }

  double x;
};

template <Way kWay>
std::unique_ptr<EnergyTerm> MakeFaulty(const ParameterValues&) {
  return ceres_ed::ForEachPoint(EnergyKind::kPrior, [](const EnergyContext& context, int i) {
    return FaultyFunctor<kWay>{(*context.points)[i].x()};
  });
}

// A node functor for residuals that are wrong without it.
struct NodeFunctor {
  static constexpr int kNumResiduals = 1;

  template <typename T>
  bool operator()(const T* node, T* residual) const {
    residual[0] = node[0];
    return true;
  }
};

std::unique_ptr<EnergyTerm> MakeOddNode(const ParameterValues&) {
  return ceres_ed::MakeEnergy(EnergyKind::kPrior, [](const EnergyContext&, ResidualSink* sink) {
    ceres_ed::AddBlockResidual(sink, 1.0, NodeFunctor{}, ceres_ed::NodeBlock{0});
    ceres_ed::AddBlockResidual(sink, 1.0, NodeFunctor{}, ceres_ed::NodeBlock{1000000});
  });
}

std::unique_ptr<EnergyTerm> MakeThrowingTerm(const ParameterValues&) {
  return ceres_ed::MakeEnergy(EnergyKind::kPrior, [](const EnergyContext&, ResidualSink* sink) {
    ceres_ed::AddBlockResidual(sink, 1.0, NodeFunctor{}, ceres_ed::NodeBlock{0});
    throw std::runtime_error("no milk");
  });
}

std::unique_ptr<EnergyTerm> ThrowInsteadOfMaking(const ParameterValues&) {
  throw std::runtime_error("no sugar");
}

ceres_ed::Status RegisterFaulty(EnergyRegistry* registry) {
  struct Energy {
    const char* name;
    EnergyRegistry::Factory factory;
  };
  const Energy energies[] = {{"fails", MakeFaulty<Way::kFails>},
                             {"throws", MakeFaulty<Way::kThrows>},
                             {"nan", MakeFaulty<Way::kNan>},
                             {"nan_derivative", MakeFaulty<Way::kNanDerivative>},
                             {"nan_once_moved", MakeFaulty<Way::kNanOnceMoved>},
                             {"odd_node", MakeOddNode},
                             {"throws_adding", MakeThrowingTerm},
                             {"throws_making", ThrowInsteadOfMaking}};
  for (const Energy& energy : energies) {
    ceres_ed::EnergyInfo info;
    info.name = energy.name;
    info.summary = "does something wrong";
    info.equation = "none";
    info.unit = "-";
    ceres_ed::Status status = registry->Register(info, energy.factory);
    if (!status.ok()) return status;
  }
  return ceres_ed::Status::Ok();
}

}  // namespace

CERES_ED_PLUGIN(RegisterFaulty)
