// Level I with hidden nodes around it marginalised (Eq. 18 to 21), from frame to frame.
#ifndef CERES_ED_SLAM_LEVELS_MARGINAL_LEVEL_H_
#define CERES_ED_SLAM_LEVELS_MARGINAL_LEVEL_H_

#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/node_set.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/slam/levels/level_window.h>
#include <ceres_ed/solver/level_solver.h>
#include <ceres_ed/solver/marginal/marginalization.h>
#include <ceres_ed/solver/strategy.h>

#include <memory>
#include <vector>

namespace ceres_ed {

// Chooses which nodes stay and which are eliminated, and takes steps. A step equals one of the
// batch solve over both. PR nodes wander: while they stay among the nodes that stayed, the
// elimination is used again.
class MarginalLevel {
 public:
  explicit MarginalLevel(const StrategyOptions& options);

  // Settles the nodes of the next problem: those of the last one, where they still do, so that its
  // factor does, too.
  void Choose(const DeformationGraph& graph, const NodeSet& point_relevant);

  // Map nodes: that are eliminated, and that stay.
  const std::vector<int>& eliminated() const { return eliminated_; }
  const std::vector<int>& kept() const { return kept_; }

  // Solves over a window whose variable nodes are eliminated(), then kept(). False, and the window
  // is as it was, when it fails.
  bool Solve(const ProblemBuilder& builder,
             bool camera_variable,
             const SolverOptions& options,
             LevelWindow* window,
             SolveSummary* summary);

  // How often nodes were chosen anew, and how often the factor was made.
  int num_choices() const { return num_choices_; }
  int num_eliminations() const { return marginalization_.num_eliminations(); }

 private:
  bool StillServes(const NodeSet& point_relevant) const;

  StrategyOptions options_;
  std::unique_ptr<LevelSolver> level_one_;
  Marginalization marginalization_;
  std::vector<int> eliminated_;
  std::vector<int> kept_;
  NodeSet is_eliminated_;
  NodeSet is_kept_;
  // Those two together.
  NodeSet reached_;
  int num_choices_ = 0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_LEVELS_MARGINAL_LEVEL_H_
