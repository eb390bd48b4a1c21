// What ed_fit prints of a fit.
#ifndef CERES_ED_APPS_FIT_TEXT_H_
#define CERES_ED_APPS_FIT_TEXT_H_

#include <ceres_ed/pipeline/fit/fit_run.h>

#include <string>

namespace ceres_ed {

// Returns a few aligned lines on how the fit went.
std::string FitSummary(const FitRun& run);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_FIT_TEXT_H_
