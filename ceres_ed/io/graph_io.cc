#include "ceres_ed/io/graph_io.h"

#include <ceres_ed/io/mesh/mesh_format.h>
#include <ceres_ed/io/mesh/position_type.h>
#include <ceres_ed/io/mesh/vertex_columns.h>

#include <array>
#include <cstddef>
#include <utility>

#include <Eigen/Core>
#include <cost_functions/node_parameters.h>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr std::array<double, 3> kRelevantColor = {240, 140, 20};
constexpr std::array<double, 3> kIrrelevantColor = {40, 90, 200};

void AppendColors(const std::vector<double>& relevant, PlyElement* nodes) {
  constexpr std::array<const char*, 3> kNames = {"red", "green", "blue"};
  for (std::size_t channel = 0; channel < kNames.size(); ++channel) {
    PlyProperty column = MakePlyScalar(kNames[channel], PlyType::kUint8);
    for (const double pr : relevant) {
      column.values.push_back(pr != 0.0 ? kRelevantColor[channel] : kIrrelevantColor[channel]);
    }
    nodes->properties.push_back(std::move(column));
  }
}

PlyElement MakeNodeElement(const DeformationGraph& graph,
                           const DeformationState& state,
                           const GraphWriteOptions& options) {
  const auto num_nodes = static_cast<std::size_t>(graph.num_nodes());
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(num_nodes);
  for (int j = 0; j < graph.num_nodes(); ++j) {
    positions.push_back(options.output_from_graph *
                        (graph.position(j) + NodeTranslation(state.node(j))));
  }
  PlyProperty pr = MakePlyScalar("pr", PlyType::kInt32, std::vector<double>(num_nodes, 0.0));
  for (std::size_t j = 0; j < options.is_point_relevant.size(); ++j) {
    pr.values[j] = options.is_point_relevant[j] ? 1.0 : 0.0;
  }
  PlyElement nodes;
  nodes.name = "vertex";
  nodes.count = num_nodes;
  AppendVectorColumns(positions, {"x", "y", "z"}, PositionType(positions), &nodes);
  const std::vector<double> relevant = pr.values;
  nodes.properties.push_back(std::move(pr));
  if (options.with_colors) AppendColors(relevant, &nodes);
  const std::vector<Eigen::Vector3d> rest(graph.positions().begin(), graph.positions().end());
  AppendVectorColumns(rest, {"rest_x", "rest_y", "rest_z"}, PositionType(rest), &nodes);
  return nodes;
}

PlyElement MakeEdgeElement(const DeformationGraph& graph) {
  PlyProperty from = MakePlyScalar("vertex1", PlyType::kInt32);
  PlyProperty to = MakePlyScalar("vertex2", PlyType::kInt32);
  PlyProperty alpha = MakePlyScalar("alpha", PlyType::kFloat32);
  for (const GraphEdge& edge : graph.edges()) {
    from.values.push_back(edge.from);
    to.values.push_back(edge.to);
    alpha.values.push_back(edge.weight);
  }
  PlyElement edges;
  edges.name = "edge";
  edges.count = graph.edges().size();
  edges.properties = {std::move(from), std::move(to), std::move(alpha)};
  return edges;
}

}  // namespace

Status WriteGraph(const std::string& path,
                  const DeformationGraph& graph,
                  const DeformationState& state,
                  const GraphWriteOptions& options) {
  CHECK_EQ(state.num_nodes(), graph.num_nodes());
  CHECK(options.is_point_relevant.empty() ||
        options.is_point_relevant.size() == static_cast<std::size_t>(graph.num_nodes()))
      << options.is_point_relevant.size() << " flags for " << graph.num_nodes() << " nodes";
  PlyDocument document;
  document.format = options.format;
  document.comments = {"embedded deformation graph"};
  document.elements = {MakeNodeElement(graph, state, options), MakeEdgeElement(graph)};
  return WriteMesh(path, document);
}

}  // namespace ceres_ed
