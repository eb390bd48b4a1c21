// A fit of files: read, fit, write, tell.
#ifndef CERES_ED_PIPELINE_FIT_FIT_RUN_H_
#define CERES_ED_PIPELINE_FIT_FIT_RUN_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/pipeline/fit/fit_files.h>
#include <ceres_ed/pipeline/fit/fit_settings.h>
#include <ceres_ed/pipeline/outcome.h>
#include <ceres_ed/pipeline/run_observer.h>
#include <ceres_ed/registration/fit_types.h>
#include <ceres_ed/util/timer.h>

#include <string>
#include <vector>

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

// How far points are from the places that landmarks give them, in the target's unit.
struct LandmarkErrors {
  int count = 0;
  double rms = 0.0;
  double max = 0.0;
};
LandmarkErrors MeasureLandmarks(const FitRun& run);

// Returns how many nodes have data.
int NumPointRelevant(const FitResult& result);

// As of RunObserver, and with the fit when it is done.
class FitObserver : public RunObserver {
 public:
  // A usable fit has ended, and its files are written.
  virtual void OnEnd(const FitRun& /*run*/) {}
};

// Returns how the run ended. `clock` runs since the start of the program; time limits and reports
// count from there.
Outcome RunFit(const FitSettings& settings, const Timer& clock, FitObserver* observer);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_FIT_FIT_RUN_H_
