// What ed_fit says of a fit: report.json for programs, a summary for people.
#ifndef CERES_ED_APPS_FIT_REPORT_H_
#define CERES_ED_APPS_FIT_REPORT_H_

#include <ceres_ed/registration/fit.h>

#include <string>
#include <vector>

#include <apps/fit_files.h>
#include <apps/fit_flags.h>
#include <nlohmann/json.hpp>

namespace ceres_ed {

// A fit with all that led to it. None of the pointers is null.
struct FitRun {
  const FitSettings* settings = nullptr;
  // Its warnings are those of the inputs, the result's are those of the fit.
  const FitFiles* files = nullptr;
  const FitResult* result = nullptr;
  const EnergyRegistry* registry = nullptr;
  // Seconds; `total_s` is from the start of the program until now.
  double load_s = 0.0;
  double write_s = 0.0;
  double total_s = 0.0;
  // All of them: FitWarnings().
  std::vector<std::string> warnings;
};

// Returns all warnings: of the inputs, of the fit, of energies and plugins that do nothing, and of
// libraries that made it slow.
std::vector<std::string> FitWarnings(const FitRun& run);

// Returns the contents of report.json; lengths are in the target's unit, but for the diagonals.
// "noise" is the standard deviation of the target's noise across its surface.
nlohmann::ordered_json FitReport(const FitRun& run);

// Returns a few aligned lines on how the fit went.
std::string FitSummary(const FitRun& run);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_FIT_REPORT_H_
