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
#include <limits>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

class LevelCovariance;
class WindowObservations;

// The label of the term that knows the camera from the rigid alignment of the frame.
inline constexpr char kPosePrior[] = "pose_prior";

// What a level did.
struct LevelReport {
  SolveStatus status = SolveStatus::kConverged;
  int variable_nodes = 0;
  int point_relevant = 0;
  // The number of variable nodes that were eliminated.
  int marginalized = 0;
  int iterations = 0;
  // The energy of the level's problem before and after the solve.
  double initial_energy = 0.0;
  double energy = 0.0;
  // The energy that the held nodes would lose at once, as a share of `energy`; NaN if it was not
  // measured (ActiveSetRule).
  double held_share = std::numeric_limits<double>::quiet_NaN();
};

// Builds and solves the levels of one frame after another, and keeps data of the solvers between
// them.
class Levels {
 public:
  // Returns new levels. It is an error if an energy or a parameter is unknown.
  static StatusOr<std::unique_ptr<Levels>> Create(const LevelsOptions& options,
                                                  const EnergyRegistry& registry);

  // Starts a new frame: the present positions of the nodes become those of the previous frame.
  void BeginFrame() {
    previous_.clear();
    solver_->active_set().BeginFrame();
  }

  // Solves Level I (Eq. 14), which moves the camera, the PR nodes and their rings. If it fails,
  // nothing has moved. `priors` may be null; the nodes then keep their present prior.
  LevelReport SolveLevelOne(const FrameObservations& observations,
                            NodePriorSource* priors,
                            DeformableMap* map);

  // Notes which nodes a Level I of these observations would move, for a frame in which none moves.
  void HoldLevelOne(const FrameObservations& observations, const DeformableMap& map);

  // Solves the same problem again until it has converged.
  LevelReport ConvergeLevelOne(const FrameObservations& observations,
                               NodePriorSource* priors,
                               DeformableMap* map);

  // Returns how well the last Level I, whose observations are given, determines the camera and the
  // nodes that it has moved (level_covariance.h). `slots` has the points of the map whose
  // covariances are wanted; those of others take longer. It is an error if a residual cannot be
  // evaluated.
  StatusOr<std::unique_ptr<LevelCovariance>> MeasureLevelOne(const FrameObservations& observations,
                                                             const std::vector<int>& slots,
                                                             const DeformableMap& map);

  // Solves Level II (Eq. 15), which moves all PI nodes, or those whose surroundings have changed.
  LevelReport SolveLevelTwo(NodePriorSource* priors, DeformableMap* map);

  // Moves PI nodes that have not followed yet, until no node is unsettled.
  LevelReport CatchUp(NodePriorSource* priors, DeformableMap* map);
  // Does the same until none of `nodes` is unsettled.
  LevelReport CatchUp(const std::vector<int>& nodes, NodePriorSource* priors, DeformableMap* map);

  // Does the same on a copy of the map. The state of the levels, which refers to the map itself,
  // does not change.
  void CatchUpCopy(NodePriorSource* priors, DeformableMap* copy);

  // Return the nodes that the last Level I moved, and its PR nodes, in ascending order.
  const NodeSet& moved_nodes() const { return moved_; }
  const NodeSet& point_relevant() const { return point_relevant_; }
  // Returns the residual (energy, plugin and index) that made a level fail since the last call, if
  // a residual was the reason; empty otherwise.
  std::string TakeFault() { return std::exchange(fault_, {}); }
  // Returns the energies of LevelsOptions::energies that have not added a residual yet.
  std::vector<std::string> IdleEnergies() const { return terms_.IdleEnergies(); }
  // Returns the pending nodes, for changes that are made outside of the levels.
  PendingNodes& pending() { return pending_; }
  // Returns whether there may be nodes that Level I does not move.
  bool HasLevelTwo() const { return solver_->HasLevelTwo(); }
  // Returns whether Level I eliminates nodes, so that its minimum is that of the batch solve.
  bool Eliminates() const { return solver_->Eliminates(); }
  // Returns the solver, which chooses the nodes and solves for them.
  const DecoupledSolver& solver() const { return *solver_; }

  // Returns the memory of data that are kept for every node. The memory of the solvers depends on
  // the size of the last windows only.
  std::size_t HeapBytes() const {
    return windows_.HeapBytes() + pending_.HeapBytes() + point_relevant_.HeapBytes() +
           moved_.HeapBytes() + front_.HeapBytes() + wanted_.HeapBytes() +
           solver_->active_set().HeapBytes();
  }

  // Discards the data that the solvers keep from frame to frame, except for the active set. They
  // save time, but the
  // order of sums depends on them, and therefore the last digits of the results.
  void ForgetSolvers();

  // Saves or loads which nodes the last levels moved. The solvers are not included.
  void Exchange(CheckpointArchive* archive);

 private:
  explicit Levels(const LevelsOptions& options)
      : options_(options), pending_(options.lazy.tolerance) {}
  // Returns whether Level II may leave nodes for later.
  bool IsLazy() const { return HasLevelTwo() && options_.level_two == LevelTwoMode::kLazy; }
  std::unique_ptr<DecoupledSolver> MakeSolver() const;
  void MarkPointRelevant(const FrameObservations& observations);
  // Chooses the nodes that a Level I of these observations moves.
  const Decoupling& ChooseNodes(const FrameObservations& observations, const DeformableMap& map);
  LevelReport SolveLevelOne(const FrameObservations& observations,
                            const SolverOptions& options,
                            NodePriorSource* priors,
                            DeformableMap* map);
  // Returns what the terms of Level I look at. `seen` and `previous` must outlive it.
  TermInputs LevelOneInputs(const FrameObservations& observations,
                            const WindowObservations& seen,
                            const LevelWindow& window,
                            const std::vector<Eigen::Vector3d>& previous) const;
  // Shows a solved Level I to the active set.
  void LookAtFrontier(const ProblemBuilder& builder,
                      const LevelWindow& window,
                      const DeformationState& before,
                      LevelReport* report);
  // Solves Level II for some PI nodes while the others are held.
  LevelReport SolveHidden(const std::vector<int>& nodes,
                          NodePriorSource* priors,
                          DeformableMap* map);
  // Sends waves from those unsettled PI nodes for which `counts` is true, until there are none.
  template <typename Counts>
  LevelReport SendWaves(int most, Counts counts, NodePriorSource* priors, DeformableMap* map);
  // Solves a level of the window by `solve(options, &summary)`, with more steps if the first ones
  // have no effect, and copies the result to the map. `motion` receives the motion of each variable
  // node.
  using SolveWindow = std::function<bool(const SolverOptions&, SolveSummary*)>;
  LevelReport Solve(const SolverOptions& options,
                    const SolveWindow& solve,
                    const LevelWindow& window,
                    DeformableMap* map,
                    std::vector<double>* motion);

  // Returns t_j of the nodes of the window one frame ago.
  std::vector<Eigen::Vector3d> PreviousOf(const LevelWindow& window, const DeformableMap& map);

  LevelsOptions options_;
  TermSet terms_;
  // The t_j, before the frame, of the nodes in its windows; kept only if there are user energies,
  // which may need them.
  std::unordered_map<int, Eigen::Vector3d> previous_;
  std::string fault_;
  LevelWindowBuilder windows_;
  std::unique_ptr<DecoupledSolver> solver_;
  NodeSet point_relevant_;
  NodeSet moved_;
  PendingNodes pending_;
  // The nodes of a wave, and the nodes for which it is sent. They are members to reuse their
  // memory.
  NodeSet front_;
  NodeSet wanted_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_LEVELS_LEVELS_H_
