#include "ceres_ed/slam/levels/level_window.h"

#include <algorithm>

#include <cost_functions/node_parameters.h>

namespace ceres_ed {

ProblemConfig LevelWindow::Config(bool camera_variable, BoundaryEdges boundary_edges) const {
  ProblemConfig config;
  config.variable_nodes.assign(nodes.size(), 0);
  std::fill_n(config.variable_nodes.begin() + num_eliminated, num_variable - num_eliminated, 1);
  if (num_eliminated > 0) {
    config.eliminated_nodes.assign(nodes.size(), 0);
    std::fill_n(config.eliminated_nodes.begin(), num_eliminated, 1);
  }
  config.camera_variable = camera_variable;
  config.boundary_edges = boundary_edges;
  return config;
}

void LevelWindowBuilder::Take(const DeformationGraph& graph,
                              const DeformationState& state,
                              int node,
                              LevelWindow* window) {
  if (local_[node] >= 0) return;
  const int index = window->graph.AddNode(graph.position(node));
  local_[node] = index;
  taken_.push_back(node);
  window->nodes.push_back(node);
  window->state.Resize(index + 1);
  std::copy_n(state.node(node), kNodeSize, window->state.node(index));
}

LevelWindow LevelWindowBuilder::Build(const DeformationGraph& graph,
                                      const DeformationState& state,
                                      const std::vector<int>& variable,
                                      const std::vector<int>& held) {
  for (const int node : taken_) local_[node] = -1;
  taken_.clear();
  local_.resize(graph.num_nodes(), -1);
  LevelWindow window;
  window.state.camera_from_map = state.camera_from_map;
  for (const int node : variable) Take(graph, state, node, &window);
  window.num_variable = static_cast<int>(window.nodes.size());
  for (const int node : held) Take(graph, state, node, &window);
  for (const int node : variable) {
    for (const int e : graph.incident_edges(node)) {
      const GraphEdge& edge = graph.edges()[e];
      const int other = edge.from == node ? edge.to : edge.from;
      Take(graph, state, other, &window);
      // An edge between two variable nodes is visited twice; its first node adds it.
      if (edge.to == node && local_[other] < window.num_variable) continue;
      window.graph.AddEdge({local_[edge.from], local_[edge.to], edge.weight});
    }
  }
  return window;
}

LevelWindow LevelWindowBuilder::Build(const DeformationGraph& graph,
                                      const DeformationState& state,
                                      const Decoupling& nodes) {
  std::vector<int> variable = nodes.eliminated.nodes();
  variable.insert(variable.end(), nodes.moved.nodes().begin(), nodes.moved.nodes().end());
  const std::vector<int>& candidates = nodes.candidates.nodes();
  variable.insert(variable.end(), candidates.begin(), candidates.end());
  LevelWindow window = Build(graph, state, variable, /*held=*/{});
  window.num_eliminated = nodes.eliminated.size();
  window.num_candidates = nodes.candidates.size();
  window.num_variable -= window.num_candidates;
  return window;
}

}  // namespace ceres_ed
