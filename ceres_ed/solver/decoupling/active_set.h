// Which PI nodes Level I moves, chosen by what it would cost to hold them.
#ifndef CERES_ED_SOLVER_DECOUPLING_ACTIVE_SET_H_
#define CERES_ED_SOLVER_DECOUPLING_ACTIVE_SET_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/node_set.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/decoupling/frontier.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace ceres_ed {

// A Level I that has been solved, as an ActiveSet looks at it. All nodes are those of the builder.
struct SolvedLevelOne {
  const ProblemBuilder* builder = nullptr;
  // Non-zero for the PI nodes that the level has moved, and for the held nodes near the moved ones.
  std::vector<char> moved_hidden;
  std::vector<char> candidates;
  // The state before and after the solve, and the energy of the level after it.
  const DeformationState* before = nullptr;
  const DeformationState* after = nullptr;
  double energy = 0.0;
  // The name of each node in the set, if the builder is that of a window; null if they are the
  // same.
  const std::vector<int>* names = nullptr;
  int num_threads = 1;
};

// The working set of Level I (StrategyOptions::active = kInformation). After a solve, the PI nodes
// near the PR nodes are put back in thought to where they were, and those that the motion of the PR
// nodes moves most by force are chosen (Frontier::Search()), until the decrements of the others add
// up to at most `bound` times the energy of Level I. The next solve moves the chosen nodes.
//
// Nodes that were PR at that time, or that are new, could not be judged. They are taken to be like
// the PI nodes next to the PR nodes: if the mean decrement of these is above the least one that was
// chosen, nodes that were not judged are moved, too.
class ActiveSet {
 public:
  // `bound` >= 0 is a share of the energy of Level I; it may be infinite.
  explicit ActiveSet(double bound) : bound_(bound) {}

  // Returns the nodes that the next Level I moves in addition to the PR nodes. Some of them may be
  // PR by then.
  const NodeSet& nodes() const { return nodes_; }
  // Returns whether nodes next to the moved ones that were not judged are moved as well, and
  // whether a node was judged.
  bool moves_unjudged() const { return moves_unjudged_; }
  bool IsJudged(int node) const { return judged_.Has(node); }
  // Returns the energy that the nodes that were held in the last solve would have lost if they had
  // been moved, as a share of the energy of Level I; NaN if it is not known.
  double held_share() const { return held_share_; }

  // Chooses nodes after a solve. They are added to those that were chosen since the last
  // BeginFrame(). Returns the number of nodes that are new in the set. If a residual can't be
  // evaluated, the set stays as it is.
  int Look(const SolvedLevelOne& level);

  // Begins a frame: with the next Look(), the set consists of what that call chooses alone.
  void BeginFrame() { is_new_frame_ = true; }

  void Clear();

  // The set as data, for checkpoints between two frames.
  struct Contents {
    std::vector<int> nodes;
    std::vector<int> judged;
    int moves_unjudged = 0;
  };
  Contents Save() const { return {nodes_.nodes(), judged_.nodes(), moves_unjudged_ ? 1 : 0}; }
  void Load(const Contents& contents);

  std::size_t HeapBytes() const { return nodes_.HeapBytes() + judged_.HeapBytes(); }

 private:
  double bound_;
  NodeSet nodes_;
  NodeSet judged_;
  bool moves_unjudged_ = false;
  bool is_new_frame_ = false;
  Frontier frontier_;
  double held_share_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_DECOUPLING_ACTIVE_SET_H_
