// Alternates matching and solving, from stiff to soft.
#ifndef CERES_ED_REGISTRATION_NONRIGID_LOOP_H_
#define CERES_ED_REGISTRATION_NONRIGID_LOOP_H_

#include <ceres_ed/registration/fit.h>
#include <ceres_ed/registration/fit_problem.h>
#include <ceres_ed/util/timer.h>

namespace ceres_ed {

// Moves `state` so that the warped `source` follows `target` (null: landmarks alone). All lengths
// are in the unit frame. Fills in status, message, point_relevant, matches, energies, iterations
// and times of `result`; `clock` started with the fit.
void RunNonrigidLoop(const Surface& source,
                     const Surface* target,
                     const BuiltGraph& graph,
                     const FitOptions& options,
                     const Timer& clock,
                     FitProblem* problem,
                     DeformationState* state,
                     FitResult* result);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_NONRIGID_LOOP_H_
