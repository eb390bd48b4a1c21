// Computes how well the result of a fit is determined.
#ifndef CERES_ED_REGISTRATION_UNCERTAINTY_FIT_UNCERTAINTY_H_
#define CERES_ED_REGISTRATION_UNCERTAINTY_FIT_UNCERTAINTY_H_

#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/fit_problem.h>
#include <ceres_ed/registration/fit_types.h>
#include <ceres_ed/registration/uncertainty/way_spread.h>
#include <ceres_ed/registration/unit_fit.h>

#include <string>
#include <vector>

namespace ceres_ed {

// Fills in `result->uncertainty` for `problem` at `state`, the end of its last round. `ways` has
// the ends of the other ways that were followed. Lengths are in the unit frame. If something is
// missing, a warning says so. Changes the weights of the problem, which must not be solved any
// more.
void MeasureUncertainty(const UnitFit& fit,
                        const BuiltGraph& graph,
                        const DeformationState& state,
                        const WaySpread& ways,
                        FitProblem* problem,
                        FitResult* result);

// Discards the uncertainty of `result`, and adds a warning with the reason `why`.
void DropUncertainty(const std::string& why, FitResult* result);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_UNCERTAINTY_FIT_UNCERTAINTY_H_
