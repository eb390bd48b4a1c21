// Which nodes Level I moves, which it eliminates and which it holds: the modes of a solve as data.
#ifndef CERES_ED_SOLVER_DECOUPLING_DECOUPLING_H_
#define CERES_ED_SOLVER_DECOUPLING_DECOUPLING_H_

#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/node_set.h>
#include <ceres_ed/problem/problem_config.h>
#include <ceres_ed/problem/problem_types.h>
#include <ceres_ed/solver/solver_types.h>

namespace ceres_ed {

// The part that each node plays in Level I. Nodes that are in neither set are held.
struct Decoupling {
  // Level I moves these, beside the camera.
  NodeSet moved;
  // These are eliminated from Level I (Eq. 20) and follow each of its steps by back-substitution
  // (Eq. 21).
  NodeSet eliminated;
  // What becomes of the priors between Level I and held nodes.
  SeamEdges seam_edges = SeamEdges::kKeep;

  bool HoldsNodes(int num_nodes) const { return moved.size() + eliminated.size() < num_nodes; }
  // Level I as a problem over a graph of `num_nodes` nodes.
  ProblemConfig LevelOne(int num_nodes, bool camera_variable) const;
  void Clear();
};

// What a choice of nodes depends on.
struct DecouplingInputs {
  const StrategyOptions* options = nullptr;
  const DeformationGraph* graph = nullptr;
  // By number.
  const NodeSet* point_relevant = nullptr;
};

// Chooses the nodes of one problem after another.
class Decoupler {
 public:
  explicit Decoupler(const StrategyOptions& options) : options_(options) {}

  // Chooses anew. `point_relevant` is sorted by number.
  const Decoupling& Choose(const DeformationGraph& graph, const NodeSet& point_relevant);

  // The same for a problem that resembles the last one. Where nodes are eliminated, the last choice
  // is kept as long as it still serves, so that its factor can be used again: no PR node is among
  // the eliminated ones, and few nodes are moved that need not be.
  const Decoupling& Update(const DeformationGraph& graph, const NodeSet& point_relevant);

  // How often nodes were chosen anew.
  int num_choices() const { return num_choices_; }

 private:
  bool StillServes(const NodeSet& point_relevant) const;

  StrategyOptions options_;
  Decoupling nodes_;
  int num_choices_ = 0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_DECOUPLING_DECOUPLING_H_
