// The levels of a fit: few nodes first, then many.
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

// Runs the levels one after the other and carries the warp from graph to graph. On the coarse
// graphs a careful way (narrow loss, strict normals) and a bold one are both tried: the careful one
// lets limbs that are far away wait until what carries them is near, the bold one fetches what
// nothing else would bring. The one that leaves less of the two surfaces unmatched goes on.
class CoarseToFine {
 public:
  explicit CoarseToFine(UnitFit fit) : fit_(std::move(fit)) {}

  // Fills in status, energies, matches, iterations, times and warnings of `result`. Error: a source
  // that no graph can be put on, an unknown energy.
  Status Run(FitResult* result);

  // The graph and the state that the fit ended with.
  const BuiltGraph& graph() const { return graphs_[graph_]; }
  const DeformationState& state() const { return state_; }

 private:
  Status BuildGraphs(int levels, FitResult* result);
  // Runs one level with `loss_width`, from `state` over graph `from` (-1: at rest).
  Status RunLevel(
      int level, const LevelPlan& plan, int from, DeformationState* state, FitResult* result) const;
  // Goes back to the rigid placement, with a warning, where the deformation explains less.
  void KeepTheBetter(FitResult* result);
  Unmatched Missed(int level, const DeformationState& state) const;

  UnitFit fit_;
  // Coarse to fine.
  std::vector<BuiltGraph> graphs_;
  int graph_ = 0;
  DeformationState state_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_COARSE_TO_FINE_H_
