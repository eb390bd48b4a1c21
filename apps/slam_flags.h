// The flags of ed_slam.
#ifndef CERES_ED_APPS_SLAM_FLAGS_H_
#define CERES_ED_APPS_SLAM_FLAGS_H_

#include <ceres_ed/pipeline/slam/slam_settings.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// How a run tells how far it is.
enum class ProgressStyle { kBar, kJson, kNone };

// What the command line asks for: the run, and what the program shows of it.
struct SlamCommand : SlamSettings {
  ProgressStyle progress = ProgressStyle::kBar;
  bool quiet = false;
};

// Returns the flags as they are now, checked. Error: names the flag, its value and what was
// expected.
StatusOr<SlamCommand> ReadSlamFlags();

// Return a line `--name=value` for each flag that a run is resumed with as it was, and for each
// that says how the levels are solved: these may change on the way, the map is the same in kind.
std::string FixedFlags();
std::string StrategyFlags();

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SLAM_FLAGS_H_
