#include "ceres_ed/problem/problem_config.h"

#include <ceres_ed/graph/node_neighborhood.h>

#include <algorithm>

namespace ceres_ed {

int ProblemConfig::NumVariableNodes() const {
  return static_cast<int>(
      std::count_if(variable_nodes.begin(), variable_nodes.end(), [](char v) { return v != 0; }));
}

ProblemConfig FullConfig(int num_nodes, bool has_camera) {
  ProblemConfig config;
  config.variable_nodes.assign(num_nodes, 1);
  config.camera_variable = has_camera;
  return config;
}

ProblemConfig LevelOneConfig(const DeformationGraph& graph,
                             const std::vector<char>& point_relevant,
                             bool has_camera,
                             BoundaryEdges boundary_edges,
                             int rings) {
  ProblemConfig config;
  config.variable_nodes = RingsAround(graph, point_relevant, rings);
  config.camera_variable = has_camera;
  config.boundary_edges = boundary_edges;
  return config;
}

ProblemConfig LevelTwoConfig(const std::vector<char>& point_relevant) {
  ProblemConfig config;
  config.variable_nodes.reserve(point_relevant.size());
  for (const char relevant : point_relevant) config.variable_nodes.push_back(relevant ? 0 : 1);
  return config;
}

}  // namespace ceres_ed
