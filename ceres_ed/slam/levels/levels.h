// The levels of a frame: camera and PR nodes against the depth image, then the PI nodes.
#ifndef CERES_ED_SLAM_LEVELS_LEVELS_H_
#define CERES_ED_SLAM_LEVELS_LEVELS_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/graph/node_set.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/problem/term_set.h>
#include <ceres_ed/slam/frame/observations.h>
#include <ceres_ed/slam/levels/level_window.h>
#include <ceres_ed/slam/levels/pending_nodes.h>
#include <ceres_ed/slam/map/deformable_map.h>
#include <ceres_ed/slam/map/node_prior_source.h>
#include <ceres_ed/slam/slam_options.h>
#include <ceres_ed/solver/decoupling/decoupled_solver.h>
#include <ceres_ed/util/status.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// What a level did.
struct LevelReport {
  SolveStatus status = SolveStatus::kConverged;
  int variable_nodes = 0;
  int point_relevant = 0;
  // Of the variable nodes.
  int marginalized = 0;
  int iterations = 0;
  // The energy of the level's problem before and after.
  double initial_energy = 0.0;
  double energy = 0.0;
};

// Builds and solves the levels of frame after frame; keeps what the solvers keep.
class Levels {
 public:
  // Error: an unknown energy or parameter.
  static StatusOr<std::unique_ptr<Levels>> Create(const LevelsOptions& options,
                                                  const EnergyRegistry& registry);

  // What nodes do from here on they do in a new frame.
  void BeginFrame() { previous_.clear(); }

  // Level I (Eq. 14): moves camera, PR nodes and their rings. On failure nothing has moved.
  // `priors` may be null: then nodes keep the prior that they have.
  LevelReport SolveLevelOne(const FrameObservations& observations,
                            NodePriorSource* priors,
                            DeformableMap* map);

  // The same problem once more, until nothing moves any more.
  LevelReport FinishLevelOne(const FrameObservations& observations,
                             NodePriorSource* priors,
                             DeformableMap* map);

  // Level II (Eq. 15): moves the PI nodes, all or those that have reason to move.
  LevelReport SolveLevelTwo(NodePriorSource* priors, DeformableMap* map);

  // Lets PI nodes that were left behind follow until none is unsettled: of all of them.
  LevelReport CatchUp(NodePriorSource* priors, DeformableMap* map);
  // And until none of `nodes` is.
  LevelReport CatchUp(const std::vector<int>& nodes, NodePriorSource* priors, DeformableMap* map);

  // The same on a copy of the map: what the levels know of the map itself, and what comes of it,
  // stays as it is.
  void CatchUpCopy(NodePriorSource* priors, DeformableMap* copy);

  // The nodes that the last Level I moved, and its PR nodes, by number.
  const NodeSet& moved_nodes() const { return moved_; }
  const NodeSet& point_relevant() const { return point_relevant_; }
  // Returns what made the last level that failed since the last call fail, where it was a residual:
  // energy, plugin and residual. Empty where there was none.
  std::string TakeFault() { return std::exchange(fault_, {}); }
  // Energies of LevelsOptions::energies that have not added a residual yet.
  std::vector<std::string> IdleEnergies() const { return terms_.IdleEnergies(); }
  // For what changes outside of the levels.
  PendingNodes& pending() { return pending_; }
  // Whether there are nodes that Level I does not move.
  bool HasLevelTwo() const { return solver_->HasLevelTwo(); }
  // Whether Level I eliminates nodes, so that its minimum is that of the batch solve.
  bool Eliminates() const { return solver_->Eliminates(); }
  // What chooses and solves for nodes.
  const DecoupledSolver& solver() const { return *solver_; }

  // Of what it keeps of every node; solvers hold what the last windows took.
  std::size_t HeapBytes() const {
    return windows_.HeapBytes() + pending_.HeapBytes() + point_relevant_.HeapBytes() +
           moved_.HeapBytes() + front_.HeapBytes() + wanted_.HeapBytes();
  }

  // Drops what the solvers keep from one frame for the next. It saves time, but the order in which
  // they sum depends on it, and with that the last digits.
  void ForgetSolvers();

  // Saves what the last levels have moved, or loads it. Solvers are not part of it.
  void Exchange(CheckpointArchive* archive);

 private:
  explicit Levels(const LevelsOptions& options)
      : options_(options), pending_(options.lazy.tolerance) {}
  // Whether nodes may be left behind.
  bool IsLazy() const { return HasLevelTwo() && options_.level_two == LevelTwoMode::kLazy; }
  std::unique_ptr<DecoupledSolver> MakeSolver() const;
  void MarkPointRelevant(const FrameObservations& observations);
  LevelReport SolveLevelOne(const FrameObservations& observations,
                            const SolverOptions& options,
                            NodePriorSource* priors,
                            DeformableMap* map);
  // Level II of some PI nodes, the others held.
  LevelReport SolveHidden(const std::vector<int>& nodes,
                          NodePriorSource* priors,
                          DeformableMap* map);
  // Waves from those unsettled PI nodes that `counts`, until there are none.
  template <typename Counts>
  LevelReport SendWaves(int most, Counts counts, NodePriorSource* priors, DeformableMap* map);
  // Solves a level of the window by `solve(options, &summary)`, with more steps where the first
  // ones bring nothing, and takes what has moved over into the map. `motion` becomes how far each
  // variable node went.
  using SolveWindow = std::function<bool(const SolverOptions&, SolveSummary*)>;
  LevelReport Solve(const SolverOptions& options,
                    const SolveWindow& solve,
                    const LevelWindow& window,
                    DeformableMap* map,
                    std::vector<double>* motion);

  // Where the nodes of a window were one frame ago.
  std::vector<Eigen::Vector3d> PreviousOf(const LevelWindow& window, const DeformableMap& map);

  LevelsOptions options_;
  TermSet terms_;
  // t_j before the frame of the nodes that its windows have taken; kept where energies of the
  // user's may ask for it.
  std::unordered_map<int, Eigen::Vector3d> previous_;
  std::string fault_;
  LevelWindowBuilder windows_;
  std::unique_ptr<DecoupledSolver> solver_;
  NodeSet point_relevant_;
  NodeSet moved_;
  PendingNodes pending_;
  // Of a wave: its nodes, and those that it is sent for. Kept for their marks.
  NodeSet front_;
  NodeSet wanted_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_LEVELS_LEVELS_H_
