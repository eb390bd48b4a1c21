// The settings of a fit of files.
#ifndef CERES_ED_PIPELINE_FIT_FIT_SETTINGS_H_
#define CERES_ED_PIPELINE_FIT_FIT_SETTINGS_H_

#include <ceres_ed/pipeline/run_flag.h>
#include <ceres_ed/registration/fit_options.h>

#include <string>

namespace ceres_ed {

// A path is empty if the file is not given or not requested.
struct FitSettings {
  FitOptions options;
  // The inputs. There must be a target, or landmarks, or both.
  std::string source;
  std::string target;
  std::string landmarks;
  std::string fixed;
  // Shared objects with more energies, separated by ";".
  std::string plugin;
  // The outputs.
  std::string output;
  std::string warp;
  std::string graph;
  std::string report;
  // The flags of the program, for the report.
  RunFlags flags;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_FIT_FIT_SETTINGS_H_
