// Smoothness in time, for tracking: nodes stay near their translation of one frame ago.
#include <ceres_ed/energy/block_energy.h>
#include <ceres_ed/energy/catalogue/catalogue.h>

#include <optional>

#include <cost_functions/node_prior_cost.h>

namespace ceres_ed {

Status RegisterTemporalSmoothness(EnergyRegistry* registry) {
  EnergyInfo info;
  info.name = "temporal_smoothness";
  info.summary = "nodes stay near where they were one frame ago (tracking)";
  info.equation = "t_j - t_j(previous frame)";
  info.unit = "length";
  return registry->Register(info, [](const ParameterValues&) {
    return ForEachNode(EnergyKind::kPrior,
                       [](const EnergyContext& context, int j) -> std::optional<NodePriorCost> {
                         if (context.node_previous == nullptr) return std::nullopt;
                         return NodePriorCost((*context.node_previous)[j]);
                       });
  });
}

}  // namespace ceres_ed
