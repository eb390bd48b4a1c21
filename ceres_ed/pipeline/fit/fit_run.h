// Fits files: reads the inputs, fits, and writes the results and the report.
#ifndef CERES_ED_PIPELINE_FIT_FIT_RUN_H_
#define CERES_ED_PIPELINE_FIT_FIT_RUN_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/pipeline/fit/fit_files.h>
#include <ceres_ed/pipeline/fit/fit_settings.h>
#include <ceres_ed/pipeline/outcome.h>
#include <ceres_ed/pipeline/run_observer.h>
#include <ceres_ed/pipeline/verdict.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/util/timer.h>

#include <cstddef>
#include <string>
#include <vector>

namespace ceres_ed {

// A fit with its inputs and settings. None of the pointers is null.
struct FitRun {
  const FitSettings* settings = nullptr;
  // Its warnings are about the inputs; those of the result are about the fit.
  const FitFiles* files = nullptr;
  const FitResult* result = nullptr;
  const EnergyRegistry* registry = nullptr;
  // Times in seconds. `total_s` is counted from the start of the program.
  double load_s = 0.0;
  double write_s = 0.0;
  double total_s = 0.0;
  // By what the source was multiplied before anything else.
  double initial_scale = 1.0;
  // All warnings (FitWarnings()).
  std::vector<std::string> warnings;
  Verdict verdict;
};

// The distances of points from the positions that landmarks give them, in the target's unit.
struct LandmarkErrors {
  int count = 0;
  double rms = 0.0;
  double max = 0.0;
};

// Returns the errors of the landmarks that draw the fit, by index or by name; only their count if
// the fit has no points.
LandmarkErrors MeasureLandmarks(const FitRun& run);

// Returns the same of a fit without files: of the first `by_index` landmarks of `input`, and of
// those that are named on both surfaces.
LandmarkErrors MeasureLandmarks(const FitInput& input,
                                std::size_t by_index,
                                std::vector<LandmarkError> named,
                                const FitResult& result);

// Returns the errors of the landmarks that are named on both surfaces, whether they drew the fit or
// not; empty if there are none, or the fit has no warp.
std::vector<LandmarkError> MeasureNamedLandmarks(const FitRun& run);

// Returns count, root of the mean square and maximum of one kind of error, for example
// &LandmarkError::after.
LandmarkErrors SummarizeLandmarks(const std::vector<LandmarkError>& errors,
                                  double LandmarkError::*kind);

// Returns the number of nodes with data (PR nodes).
int NumPointRelevant(const FitResult& result);

// A RunObserver that also receives the fit.
class FitObserver : public RunObserver {
 public:
  // Called after a usable fit has ended and its files have been written.
  virtual void OnEnd(const FitRun& /*run*/) {}
};

// Fits the files and returns how the run ended. `clock` must have been started with the program:
// the time limit and the reported times are counted from there.
Outcome RunFit(const FitSettings& settings, const Timer& clock, FitObserver* observer);

// What fits of one source to many targets share. The fitter is one of the source, and may be null:
// then each fit prepares the source itself, and what it finds is the same.
struct SharedSource {
  const EnergyRegistry* registry = nullptr;
  const FitSource* source = nullptr;
  const SurfaceFitter* fitter = nullptr;
};

// Does the same with a source that has been read, and energies that have been loaded, before. May
// be called from several threads at once.
Outcome RunFit(const FitSettings& settings,
               const SharedSource& shared,
               const Timer& clock,
               FitObserver* observer);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_FIT_FIT_RUN_H_
