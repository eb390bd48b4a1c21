// The resolutions of a fit, from few nodes to many.
#ifndef CERES_ED_REGISTRATION_COARSE_TO_FINE_H_
#define CERES_ED_REGISTRATION_COARSE_TO_FINE_H_

#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/fit_types.h>
#include <ceres_ed/registration/hypotheses/hypothesis.h>
#include <ceres_ed/registration/nonrigid_loop.h>
#include <ceres_ed/registration/unit_fit.h>

#include <utility>
#include <vector>

namespace ceres_ed {

// Runs the resolutions one after the other and transfers the warp from graph to graph. The coarse
// graphs are fitted by each hypothesis in turn (hypotheses/hypothesis.h), and the fit continues
// with the state that leaves least to explain (hypotheses/explanation.h).
class CoarseToFine {
 public:
  explicit CoarseToFine(UnitFit fit) : fit_(std::move(fit)) {}

  // Fills in status, energies, matches, iterations, times and warnings of `result`. It is an error
  // if no graph can be built on the source, or if an energy is unknown.
  Status Run(FitResult* result);

  // Return the graph and the state at the end of the fit.
  const BuiltGraph& graph() const { return graphs_[graph_]; }
  const DeformationState& state() const { return state_; }

 private:
  Status BuildGraphs(int resolutions, FitResult* result);
  // Returns the state of the nodes of `resolution` under the warp of `graph`.
  DeformationState CarryOver(const BuiltGraph& graph,
                             const DeformationState& state,
                             int resolution) const;
  // Runs one resolution as `plan` says, from `state`.
  Status RunResolution(int resolution,
                       const ResolutionPlan& plan,
                       DeformationState* state,
                       FitResult* result) const;
  // Runs all resolutions but the last one in one way; `reached` is the resolution of `state`.
  Status FollowCoarse(const Hypothesis& hypothesis,
                      const std::vector<ResolutionPlan>& plans,
                      DeformationState* state,
                      int* reached,
                      FitResult* result) const;
  // Tries the hypotheses, and stores the state that leaves least to explain, and its graph.
  // `loss_width` becomes that of the hypothesis.
  Status ChooseHypothesis(const std::vector<ResolutionPlan>& plans,
                          double* loss_width,
                          FitResult* result);
  // Returns to the rigid placement, with a warning, if the deformation explains less of the
  // surfaces. With energies of the user, which may ask for something else, it must explain clearly
  // less.
  void KeepTheBetter(FitResult* result);
  UnitFit fit_;
  // The graphs from coarse to fine.
  std::vector<BuiltGraph> graphs_;
  int graph_ = 0;
  DeformationState state_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_COARSE_TO_FINE_H_
