// An energy that pulls every node's translation to zero.
#include <ceres_ed/plugin/plugin_abi.h>

#include <memory>
#include <utility>

#include <ceres/autodiff_cost_function.h>
#include <cost_functions/node_parameters.h>

namespace {

struct AnchorCost {
  template <typename T>
  bool operator()(const T* node, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = gain * node[ceres_ed::kNodeTranslationOffset + i];
    return true;
  }

  double gain;
};

class AnchorTerm : public ceres_ed::EnergyTerm {
 public:
  explicit AnchorTerm(double gain) : gain_(gain) {}

  ceres_ed::EnergyKind kind() const override { return ceres_ed::EnergyKind::kPrior; }

  void AddResiduals(const ceres_ed::EnergyContext& context,
                    ceres_ed::ResidualSink* sink) const override {
    using Cost = ceres::AutoDiffCostFunction<AnchorCost, 3, ceres_ed::kNodeSize>;
    for (int j = 0; j < context.graph->num_nodes(); ++j) {
      const auto block = ceres_ed::BlockRef::Node(j);
      sink->Add(std::make_unique<Cost>(new AnchorCost{gain_}), &block, 1);
    }
  }

 private:
  double gain_;
};

ceres_ed::Status RegisterAnchor(ceres_ed::EnergyRegistry* registry) {
  ceres_ed::EnergyInfo info;
  info.name = "anchor";
  info.summary = "pulls every node's translation to zero";
  info.equation = "gain * t_j";
  info.unit = "map unit";
  ceres_ed::EnergyParameter gain;
  gain.name = "gain";
  gain.minimum = 0.0;
  gain.maximum = 10.0;
  gain.default_value = 2.0;
  gain.doc = "factor of the residual";
  info.parameters = {gain};
  return registry->Register(std::move(info), [](const ceres_ed::ParameterValues& values) {
    return std::make_unique<AnchorTerm>(values.Get("gain"));
  });
}

}  // namespace

CERES_ED_PLUGIN(RegisterAnchor)
