// E_rot (Eq. 5).
#include <ceres_ed/energy/catalogue/catalogue.h>
#include <ceres_ed/energy/prior_stores.h>

#include <memory>

#include <cost_functions/rotation_cost.h>

namespace ceres_ed {
namespace {

// This energy does not use ForEachNode(), since the solver has a closed form for the residuals of
// RotationStore.
class RotationEnergy final : public EnergyTerm {
 public:
  EnergyKind kind() const override { return EnergyKind::kPrior; }

  void AddResiduals(const EnergyContext& context, ResidualSink* sink) const override {
    auto* store = FindStore<RotationStore>(sink);
    for (int j = 0; j < context.graph->num_nodes(); ++j) {
      const BlockRef block = BlockRef::Node(j);
      if (store != nullptr) {
        store->Add();
        sink->AddStored(store, &block, 1, 1.0);
      } else {
        sink->Add(std::unique_ptr<ceres::CostFunction>(RotationCost::Create()), &block, 1);
      }
    }
  }
};

}  // namespace

Status RegisterRotation(EnergyRegistry* registry) {
  EnergyInfo info;
  info.name = "rotation";
  info.summary = "each node's affine matrix stays near a rotation";
  info.equation = "c1.c2, c1.c3, c2.c3, c1.c1-1, c2.c2-1, c3.c3-1 (Eq. 5)";
  info.unit = "-";
  return registry->Register(
      info, [](const ParameterValues&) { return std::make_unique<RotationEnergy>(); });
}

}  // namespace ceres_ed
