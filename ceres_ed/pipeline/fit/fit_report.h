// What is told of a fit of files: report.json, and warnings.
#ifndef CERES_ED_PIPELINE_FIT_FIT_REPORT_H_
#define CERES_ED_PIPELINE_FIT_FIT_REPORT_H_

#include <ceres_ed/pipeline/fit/fit_run.h>

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Returns all warnings: of the inputs, of the fit, of energies and plugins that do nothing, and of
// libraries that made it slow.
std::vector<std::string> FitWarnings(const FitRun& run);

// Returns the contents of report.json; lengths are in the target's unit, but for the diagonals.
// "noise" is the standard deviation of the target's noise across its surface.
nlohmann::ordered_json FitReport(const FitRun& run);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_FIT_FIT_REPORT_H_
