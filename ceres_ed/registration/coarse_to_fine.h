// The resolutions of a fit, from few nodes to many.
#ifndef CERES_ED_REGISTRATION_COARSE_TO_FINE_H_
#define CERES_ED_REGISTRATION_COARSE_TO_FINE_H_

#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/fit_types.h>
#include <ceres_ed/registration/matching.h>
#include <ceres_ed/registration/nonrigid_loop.h>
#include <ceres_ed/registration/unit_fit.h>

#include <utility>
#include <vector>

namespace ceres_ed {

// Runs the resolutions one after the other and transfers the warp from graph to graph. On the
// coarse graphs two ways are tried: a careful one (narrow loss, strict normals) and a bold one.
// With the careful way, limbs that are far away do not move until the parts that support them are
// near; with the bold way, parts are moved that would otherwise not be reached. The fit continues
// with the way that leaves less of the two surfaces unmatched.
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
  // Runs one resolution with the loss of `plan`, starting from `state` on the graph `from` (-1:
  // from rest).
  Status RunResolution(int resolution,
                       const ResolutionPlan& plan,
                       int from,
                       DeformationState* state,
                       FitResult* result) const;
  // Returns to the rigid placement, with a warning, if the deformation explains less of the
  // surfaces. With energies of the user, which may ask for something else, it must explain clearly
  // less.
  void KeepTheBetter(FitResult* result);
  // Returns how much of both surfaces is unmatched in `state` on the graph of `resolution`; a point
  // at the distance `width` counts half.
  Unmatched MeasureUnmatched(int resolution, const DeformationState& state, double width) const;
  // Returns how much of the surfaces `state` on the last graph leaves unexplained: what is
  // unmatched, and the area that is squeezed away to match the rest.
  double MeasureUnexplained(const DeformationState& state) const;

  UnitFit fit_;
  // The graphs from coarse to fine.
  std::vector<BuiltGraph> graphs_;
  int graph_ = 0;
  DeformationState state_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_COARSE_TO_FINE_H_
