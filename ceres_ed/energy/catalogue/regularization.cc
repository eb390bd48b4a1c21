// E_reg (Eq. 6).
#include <ceres_ed/energy/catalogue/catalogue.h>
#include <ceres_ed/energy/prior_stores.h>

#include <memory>

#include <cost_functions/regularization_cost.h>

namespace ceres_ed {
namespace {

// This energy does not use ForEachEdge(), since the solver has a closed form for the residuals of
// EdgeStore.
class RegularizationEnergy final : public EnergyTerm {
 public:
  EnergyKind kind() const override { return EnergyKind::kPrior; }

  void AddResiduals(const EnergyContext& context, ResidualSink* sink) const override {
    const DeformationGraph& graph = *context.graph;
    auto* store = FindStore<EdgeStore>(sink);
    for (const GraphEdge& edge : graph.edges()) {
      const BlockRef blocks[] = {BlockRef::Node(edge.from), BlockRef::Node(edge.to)};
      const RegularizationCost cost(
          graph.position(edge.from), graph.position(edge.to), edge.weight);
      if (store != nullptr) {
        store->Add(cost);
        sink->AddStored(store, blocks, 2, 1.0);
      } else {
        sink->Add(std::unique_ptr<ceres::CostFunction>(cost.MakeCostFunction()), blocks, 2);
      }
    }
  }
};

}  // namespace

Status RegisterRegularization(EnergyRegistry* registry) {
  EnergyInfo info;
  info.name = "regularization";
  info.summary = "neighbouring nodes agree on where each of them goes";
  info.equation = "sqrt(alpha_jk) [A_j (g_k - g_j) + g_j + t_j - (g_k + t_k)] (Eq. 6)";
  info.unit = "length";
  return registry->Register(
      info, [](const ParameterValues&) { return std::make_unique<RegularizationEnergy>(); });
}

}  // namespace ceres_ed
