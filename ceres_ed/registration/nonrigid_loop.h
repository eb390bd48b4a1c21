// Alternates matching and solving, from stiff to soft.
#ifndef CERES_ED_REGISTRATION_NONRIGID_LOOP_H_
#define CERES_ED_REGISTRATION_NONRIGID_LOOP_H_

#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/fit_problem.h>
#include <ceres_ed/registration/fit_types.h>
#include <ceres_ed/registration/unit_fit.h>
#include <ceres_ed/solver/strategy.h>

#include <vector>

namespace ceres_ed {

// What one level of the schedule does.
struct LevelPlan {
  // E_rot and E_reg at the first and at the last step, as multiples of their weights.
  double first_stiffness = 1.0;
  double last_stiffness = 1.0;
  int steps = 1;
  // The others end before anyone asks for their energies.
  bool is_last = true;
  // Of the data loss, as a multiple of the robust standard deviation of the residuals.
  double loss_width = 10.0;
  // Of the normals of a pair, degrees.
  double max_angle_deg = 75.0;
  // Points of each surface that are matched, and in the last step.
  int samples = 1000;
  int last_samples = 1000;
  // What of the whole fit is done before and after this level, in [0, 1].
  double progress_begin = 0.0;
  double progress_end = 1.0;
};

// Fewer points of a surface than these are not matched unless it has no more.
inline constexpr int kMinCoarseSamples = 1000;

// The plans of `levels` >= 1 levels of `fit`, coarse to fine.
std::vector<LevelPlan> PlanLevels(const UnitFit& fit, int levels);

// Moves `state` over `graph` so that the warped source follows the target. `problem` has the
// energies of the fit. Fills in status, message, point_relevant, matches, energies, iterations and
// times of `result`. The status stays failed, interrupted or time_limit where the loop ended early.
void RunNonrigidLoop(const UnitFit& fit,
                     const BuiltGraph& graph,
                     const LevelPlan& plan,
                     FitProblem* problem,
                     DeformationState* state,
                     FitResult* result);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_NONRIGID_LOOP_H_
