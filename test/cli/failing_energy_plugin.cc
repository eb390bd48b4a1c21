// An energy whose residuals can never be evaluated: a solve with it fails.
#include <ceres_ed/plugin/plugin_abi.h>

#include <memory>

#include <ceres/sized_cost_function.h>
#include <cost_functions/node_parameters.h>

namespace {

class FailingCost : public ceres::SizedCostFunction<1, ceres_ed::kNodeSize> {
 public:
  bool Evaluate(double const* const*, double*, double**) const override { return false; }
};

class FailingTerm : public ceres_ed::EnergyTerm {
 public:
  ceres_ed::EnergyKind kind() const override { return ceres_ed::EnergyKind::kPrior; }

  void AddResiduals(const ceres_ed::EnergyContext&, ceres_ed::ResidualSink* sink) const override {
    const auto block = ceres_ed::BlockRef::Node(0);
    sink->Add(std::make_unique<FailingCost>(), &block, 1);
  }
};

ceres_ed::Status RegisterFailing(ceres_ed::EnergyRegistry* registry) {
  ceres_ed::EnergyInfo info;
  info.name = "failing";
  info.summary = "fails";
  info.equation = "none";
  info.unit = "-";
  return registry->Register(
      info, [](const ceres_ed::ParameterValues&) { return std::make_unique<FailingTerm>(); });
}

}  // namespace

CERES_ED_PLUGIN(RegisterFailing)
