// The flags of ed_fit.
#ifndef CERES_ED_APPS_FIT_FLAGS_H_
#define CERES_ED_APPS_FIT_FLAGS_H_

#include <ceres_ed/registration/fit.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// What the command line asks for. Paths are empty where a flag is not given.
struct FitSettings {
  FitOptions options;
  std::string output;
  std::string landmarks;
  std::string fixed;
  std::string plugin;
  std::string warp;
  std::string graph;
  std::string report;
  bool quiet = false;
};

// Returns the flags as they are now, checked. Error: names the flag, its value and what was
// expected.
StatusOr<FitSettings> ReadFitFlags();

// "batch" or "two_level".
std::string SolveModeName(SolveMode mode);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_FIT_FLAGS_H_
