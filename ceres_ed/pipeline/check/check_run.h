// The run behind ed_check: looks at the inputs of a fit, and does nothing else.
#ifndef CERES_ED_PIPELINE_CHECK_CHECK_RUN_H_
#define CERES_ED_PIPELINE_CHECK_CHECK_RUN_H_

#include <ceres_ed/pipeline/outcome.h>
#include <ceres_ed/pipeline/run_observer.h>
#include <ceres_ed/preflight/finding.h>

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {

struct CheckSettings {
  std::string source;
  // Empty if one file alone is looked at.
  std::string target;
};

// A RunObserver that also receives the findings.
class CheckObserver : public RunObserver {
 public:
  virtual void OnFindings(const std::vector<Finding>& /*findings*/) {}
};

// Reads the files and looks at them. Faults are no failure: only a file that cannot be read is.
// Warnings are about what was left out while reading.
Outcome RunCheck(const CheckSettings& settings, CheckObserver* observer);

// Returns the JSON of `ed_check --json`.
nlohmann::ordered_json CheckReport(const CheckSettings& settings,
                                   const std::vector<Finding>& findings);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_CHECK_CHECK_RUN_H_
