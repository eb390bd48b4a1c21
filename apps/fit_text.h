// The text that ed_fit prints about a fit.
#ifndef CERES_ED_APPS_FIT_TEXT_H_
#define CERES_ED_APPS_FIT_TEXT_H_

#include <ceres_ed/pipeline/fit/fit_run.h>

#include <string>

namespace ceres_ed {

// Returns a summary of the fit in a few aligned lines.
std::string FitSummary(const FitRun& run);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_FIT_TEXT_H_
