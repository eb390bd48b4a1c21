// The report of a fit of files: report.json and the warnings.
#ifndef CERES_ED_PIPELINE_FIT_FIT_REPORT_H_
#define CERES_ED_PIPELINE_FIT_FIT_REPORT_H_

#include <ceres_ed/pipeline/fit/fit_run.h>

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Returns all warnings: those about the inputs, about the fit, about energies and plugins that have
// no effect, and about libraries that made the fit slow.
std::vector<std::string> FitWarnings(const FitRun& run);

// Returns the contents of report.json. Lengths are in the target's unit, except for the diagonals,
// which are in the unit of their file, and the standard deviations of "covariance", which are in
// the source's unit. "noise" is the standard deviation of the target's noise across its surface.
nlohmann::ordered_json FitReport(const FitRun& run);

// Returns those fields that follow from the result and its verdict alone, of a fit without files:
// status, message, nodes, energies, unmatched shares, covariance, verdict, times and warnings.
nlohmann::ordered_json FitResultReport(const FitResult& result, const Verdict& verdict);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_FIT_FIT_REPORT_H_
