// Keeps nodes near an expected translation.
#include <ceres_ed/energy/block_energy.h>
#include <ceres_ed/energy/catalogue/catalogue.h>

#include <optional>

#include <cost_functions/node_prior_cost.h>

namespace ceres_ed {

Status RegisterNodePrior(EnergyRegistry* registry) {
  EnergyInfo info;
  info.name = "node_prior";
  info.summary = "nodes stay near where they are thought to be";
  info.equation = "t_j - t_prior";
  info.unit = "length";
  return registry->Register(info, [](const ParameterValues&) {
    return ForEachNode(EnergyKind::kPrior,
                       [](const EnergyContext& context, int j) -> std::optional<NodePriorCost> {
                         if (context.node_prior == nullptr) return std::nullopt;
                         return NodePriorCost((*context.node_prior)[j]);
                       });
  });
}

}  // namespace ceres_ed
