// What a fit of files is asked to do.
#ifndef CERES_ED_PIPELINE_FIT_FIT_SETTINGS_H_
#define CERES_ED_PIPELINE_FIT_FIT_SETTINGS_H_

#include <ceres_ed/pipeline/run_flag.h>
#include <ceres_ed/registration/fit_options.h>

#include <string>

namespace ceres_ed {

// Paths are empty where a file is not given or not wanted.
struct FitSettings {
  FitOptions options;
  // Inputs. Either a target or landmarks must be there.
  std::string source;
  std::string target;
  std::string landmarks;
  std::string fixed;
  // Shared objects with more energies, several with ";" between them.
  std::string plugin;
  // Outputs.
  std::string output;
  std::string warp;
  std::string graph;
  std::string report;
  // For the report.
  RunFlags flags;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_FIT_FIT_SETTINGS_H_
