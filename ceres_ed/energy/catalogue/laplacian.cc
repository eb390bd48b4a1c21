// Smoothness of the motion of nodes.
#include <ceres_ed/energy/block_energy.h>
#include <ceres_ed/energy/catalogue/catalogue.h>

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <cost_functions/laplacian_cost.h>

namespace ceres_ed {
namespace {

// Adds the residual of node `j` and the nodes to which its edges lead. The weights of these edges
// are normalised to sum 1.
void AddLaplacian(const DeformationGraph& graph, int j, ResidualSink* sink) {
  std::map<int, double> alpha;
  double sum = 0.0;
  for (const int e : graph.incident_edges(j)) {
    const GraphEdge& edge = graph.edges()[e];
    if (edge.from != j || edge.to == j) continue;
    alpha[edge.to] += edge.weight;
    sum += edge.weight;
  }
  if (!(sum > 0.0)) return;
  std::vector<BlockRef> blocks = {BlockRef::Node(j)};
  std::vector<double> weights;
  for (const auto& [k, weight] : alpha) {
    blocks.push_back(BlockRef::Node(k));
    weights.push_back(weight / sum);
  }
  sink->Add(std::make_unique<LaplacianCost>(std::move(weights)),
            blocks.data(),
            static_cast<int>(blocks.size()));
}

}  // namespace

Status RegisterLaplacian(EnergyRegistry* registry) {
  EnergyInfo info;
  info.name = "laplacian";
  info.summary = "each node moves like the mean of its neighbours";
  info.equation = "t_j - sum_k alpha_jk t_k / sum_k alpha_jk";
  info.unit = "length";
  return registry->Register(info, [](const ParameterValues&) {
    return MakeEnergy(EnergyKind::kPrior, [](const EnergyContext& context, ResidualSink* sink) {
      for (int j = 0; j < context.graph->num_nodes(); ++j) AddLaplacian(*context.graph, j, sink);
    });
  });
}

}  // namespace ceres_ed
