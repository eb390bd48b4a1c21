// Alternates between matching and solving, with decreasing stiffness.
#ifndef CERES_ED_REGISTRATION_NONRIGID_LOOP_H_
#define CERES_ED_REGISTRATION_NONRIGID_LOOP_H_

#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/fit_problem.h>
#include <ceres_ed/registration/fit_types.h>
#include <ceres_ed/registration/matching.h>
#include <ceres_ed/registration/unit_fit.h>
#include <ceres_ed/solver/strategy.h>

#include <functional>
#include <vector>

namespace ceres_ed {

// What one resolution of the schedule does.
struct ResolutionPlan {
  // The factors of the weights of E_rot and E_reg in the first and in the last step.
  double first_stiffness = 1.0;
  double last_stiffness = 1.0;
  // The number of steps, each with its own stiffness.
  int steps = 1;
  // Whether this is the last resolution; the energies of the others are not reported.
  bool is_last = true;
  // The width of the data loss, as a multiple of the robust standard deviation of the residuals.
  double loss_width = 10.0;
  // The largest angle between the normals of a pair, in degrees.
  double max_angle_deg = 75.0;
  // The number of points of each surface that are matched, and that number in the last step.
  int samples = 1000;
  int last_samples = 1000;
  // Called after each step but the last one with the share of the surfaces that is unmatched, if it
  // is set; if it returns false, the resolution ends there.
  std::function<bool(int step, const Unmatched& unmatched)> keep_going;
  // The distance at which a point counts half as unmatched for `keep_going`, in the unit frame.
  double unmatched_width = 0.02;
  // The progress of the whole fit before and after this resolution, in [0, 1].
  double progress_begin = 0.0;
  double progress_end = 1.0;
};

// Returns true, with the status and the reason in `result`, if the fit must end now because its
// time is up or because it was interrupted.
bool MustEnd(const UnitFit& fit, FitResult* result);

// At least this many points of a surface are matched, or all if it has fewer.
inline constexpr int kMinCoarseSamples = 1000;

// Returns the plans of the `resolutions` >= 1 resolutions of `fit`, from coarse to fine.
std::vector<ResolutionPlan> PlanResolutions(const UnitFit& fit, int resolutions);

// Moves `state` on `graph` so that the warped source follows the target. `problem` contains the
// energies of the fit. Fills in status, message, point_relevant, matches, energies, iterations and
// times of `result`. The status is failed, interrupted or time_limit if the loop ended early.
void RunNonrigidLoop(const UnitFit& fit,
                     const BuiltGraph& graph,
                     const ResolutionPlan& plan,
                     FitProblem* problem,
                     DeformationState* state,
                     FitResult* result);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_NONRIGID_LOOP_H_
