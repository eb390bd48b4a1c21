#include "ceres_ed/solver/decoupling/decoupling.h"

#include <ceres_ed/solver/strategies/strategy_table.h>

#include <vector>

namespace ceres_ed {
namespace {

// The number of nodes that are moved without need, as a share of the PR nodes, above which a new
// choice saves time.
constexpr double kMostIdle = 0.5;

std::vector<char> MaskOf(const NodeSet& nodes, int num_nodes) {
  std::vector<char> mask(num_nodes, 0);
  for (const int node : nodes.nodes()) mask[node] = 1;
  return mask;
}

}  // namespace

ProblemConfig Decoupling::LevelOne(int num_nodes, bool camera_variable) const {
  ProblemConfig config;
  config.variable_nodes = MaskOf(moved, num_nodes);
  config.camera_variable = camera_variable;
  config.boundary_edges = boundary_edges;
  if (!eliminated.empty()) config.eliminated_nodes = MaskOf(eliminated, num_nodes);
  return config;
}

void Decoupling::Clear() {
  moved.Clear();
  eliminated.Clear();
  candidates.Clear();
  boundary_edges = BoundaryEdges::kKeep;
}

const Decoupling& Decoupler::Choose(const DeformationGraph& graph, const NodeSet& point_relevant) {
  ++num_choices_;
  nodes_.Clear();
  const DecouplingInputs inputs = {&options_, &graph, &point_relevant, &active_set_};
  FindStrategy(options_.mode).choose(inputs, &nodes_);
  return nodes_;
}

const Decoupling& Decoupler::Update(const DeformationGraph& graph, const NodeSet& point_relevant) {
  const bool eliminates = FindStrategy(options_.mode).hidden == HiddenNodes::kAreEliminated;
  if (!eliminates || !StillServes(point_relevant)) return Choose(graph, point_relevant);
  for (const int node : point_relevant.nodes()) nodes_.moved.Add(node);
  return nodes_;
}

bool Decoupler::StillServes(const NodeSet& point_relevant) const {
  if (nodes_.moved.empty()) return false;
  for (const int node : point_relevant.nodes()) {
    if (nodes_.eliminated.Has(node)) return false;
  }
  return nodes_.moved.size() <= (1.0 + kMostIdle) * point_relevant.size() + 1.0;
}

}  // namespace ceres_ed
