// The resolutions of a fit, from few nodes to many.
#ifndef CERES_ED_REGISTRATION_COARSE_TO_FINE_H_
#define CERES_ED_REGISTRATION_COARSE_TO_FINE_H_

#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/fit_problem.h>
#include <ceres_ed/registration/fit_types.h>
#include <ceres_ed/registration/graph_pyramid.h>
#include <ceres_ed/registration/hypotheses/portfolio.h>
#include <ceres_ed/registration/nonrigid_loop.h>
#include <ceres_ed/registration/uncertainty/way_spread.h>
#include <ceres_ed/registration/unit_fit.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace ceres_ed {

// Runs the resolutions one after the other and transfers the warp from graph to graph. The coarse
// graphs are fitted in several ways (hypotheses/portfolio.h), and the fit continues with the state
// that leaves least to explain (hypotheses/explanation.h).
class CoarseToFine {
 public:
  explicit CoarseToFine(UnitFit fit) : fit_(std::move(fit)) {}

  // Fills in status, energies, matches, uncertainty, iterations, times and warnings of `result`. It
  // is an error if no graph can be built on the source, or if an energy is unknown.
  Status Run(FitResult* result);

  // Return the graph and the state at the end of the fit.
  const BuiltGraph& graph() const { return (*graphs_)[graph_]; }
  const DeformationState& state() const { return state_; }

 private:
  // Follows the target on the finest graph from each of `attempts`, and keeps the best.
  Status FollowFine(std::vector<Attempt> attempts, FitResult* result);
  // Follows the target on the finest graph from the state of `attempt`, and stores the problem.
  Status FollowFinest(Attempt* attempt,
                      std::unique_ptr<FitProblem>* problem,
                      FitResult* result) const;
  // Notes where an attempt ends.
  void Note(const Attempt& attempt);
  // Makes the state of `attempt` that of the fit.
  void Take(Attempt attempt, FitResult* result);
  // Returns to the rigid placement, with a warning, if the deformation is worse than that, and
  // takes a rigid motion if the surfaces do not show more. Measures how certain the deformation is,
  // if this is asked for.
  void Conclude(FitResult* result);

  UnitFit fit_;
  std::optional<GraphPyramid> graphs_;
  // What is done on each graph.
  std::vector<ResolutionPlan> plans_;
  int graph_ = 0;
  DeformationState state_;
  // The problem on the finest graph of which `state_` is the solution.
  std::unique_ptr<FitProblem> problem_;
  // The ends of the ways that were followed, if the uncertainty is asked for.
  WaySpread ways_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_COARSE_TO_FINE_H_
