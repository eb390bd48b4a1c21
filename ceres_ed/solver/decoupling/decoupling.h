// Which nodes Level I moves, which it eliminates and which it holds: the modes of a solve as data.
#ifndef CERES_ED_SOLVER_DECOUPLING_DECOUPLING_H_
#define CERES_ED_SOLVER_DECOUPLING_DECOUPLING_H_

#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/node_set.h>
#include <ceres_ed/problem/problem_config.h>
#include <ceres_ed/problem/problem_types.h>
#include <ceres_ed/solver/decoupling/active_set.h>
#include <ceres_ed/solver/solver_types.h>

namespace ceres_ed {

// The role of each node in Level I. Nodes that are in neither set are held.
struct Decoupling {
  // The nodes that Level I moves, in addition to the camera.
  NodeSet moved;
  // The nodes that are eliminated from Level I (Eq. 20). They follow each of its steps by
  // back-substitution (Eq. 21).
  NodeSet eliminated;
  // The held nodes near the moved ones that the next Level I may move, in ascending order; only
  // with ActiveSetRule::kInformation.
  NodeSet candidates;
  // How priors between moved and held nodes are treated in Level I.
  BoundaryEdges boundary_edges = BoundaryEdges::kKeep;

  // Returns whether some of `num_nodes` nodes are held.
  bool HoldsNodes(int num_nodes) const { return moved.size() + eliminated.size() < num_nodes; }
  // Returns Level I as a problem over a graph of `num_nodes` nodes.
  ProblemConfig LevelOne(int num_nodes, bool camera_variable) const;
  void Clear();
};

// The inputs on which a choice of nodes depends.
struct DecouplingInputs {
  const StrategyOptions* options = nullptr;
  const DeformationGraph* graph = nullptr;
  // The PR nodes, in ascending order.
  const NodeSet* point_relevant = nullptr;
  const ActiveSet* active = nullptr;
};

// Chooses the nodes of one problem after another.
class Decoupler {
 public:
  explicit Decoupler(const StrategyOptions& options)
      : options_(options), active_set_(options.active_bound) {}

  // Chooses the nodes of a new problem. `point_relevant` must be in ascending order.
  const Decoupling& Choose(const DeformationGraph& graph, const NodeSet& point_relevant);

  // Chooses the nodes of a problem that resembles the last one. If nodes are eliminated, the last
  // choice is kept as long as no PR node is among the eliminated nodes and few nodes are moved
  // without need. The factor of the elimination can then be used again.
  const Decoupling& Update(const DeformationGraph& graph, const NodeSet& point_relevant);

  // Returns the nodes that are moved by ActiveSetRule::kInformation.
  ActiveSet& active_set() { return active_set_; }
  const ActiveSet& active_set() const { return active_set_; }

  // Returns how often nodes were chosen again.
  int num_choices() const { return num_choices_; }

 private:
  bool StillServes(const NodeSet& point_relevant) const;

  StrategyOptions options_;
  ActiveSet active_set_;
  Decoupling nodes_;
  int num_choices_ = 0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_DECOUPLING_DECOUPLING_H_
