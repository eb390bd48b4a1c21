#include "ceres_ed/slam/levels/edge_weights.h"

#include <Eigen/Core>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {

void UpdateEdgeWeights(const std::vector<int>& nodes, double yield_strain, DeformableMap* map) {
  const DeformationGraph& graph = map->graph();
  for (const int node : nodes) {
    const Eigen::Matrix3d affine = NodeAffine(map->state().node(node));
    const Eigen::Vector3d position = map->NodePosition(node);
    for (const int e : graph.incident_edges(node)) {
      const GraphEdge& edge = graph.edges()[e];
      if (edge.from != node) continue;
      const Eigen::Vector3d predicted =
          affine * (graph.position(edge.to) - graph.position(node)) + position;
      const double ratio = (predicted - map->NodePosition(edge.to)).norm() / yield_strain;
      const double softness = 1.0 + ratio * ratio;
      map->SetEdgeWeight(e, 1.0 / (softness * softness));
    }
  }
}

}  // namespace ceres_ed
