// How well the end of a fit is determined.
#ifndef CERES_ED_REGISTRATION_FIT_UNCERTAINTY_H_
#define CERES_ED_REGISTRATION_FIT_UNCERTAINTY_H_

#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/fit_problem.h>
#include <ceres_ed/registration/fit_types.h>
#include <ceres_ed/registration/unit_fit.h>

#include <string>
#include <vector>

namespace ceres_ed {

// Fills in `result->uncertainty`, with lengths in the unit frame, for `problem` at `state`, where
// its last round ended; a warning says what is missing.
void MeasureUncertainty(const UnitFit& fit,
                        const BuiltGraph& graph,
                        const FitProblem& problem,
                        const DeformationState& state,
                        FitResult* result);

// Drops what it filled in, and warns.
void DropUncertainty(const std::string& why, FitResult* result);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FIT_UNCERTAINTY_H_
