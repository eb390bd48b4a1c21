// The flags of ed_slam.
#ifndef CERES_ED_APPS_SLAM_FLAGS_H_
#define CERES_ED_APPS_SLAM_FLAGS_H_

#include <ceres_ed/pipeline/slam/slam_settings.h>
#include <ceres_ed/util/named_values.h>
#include <ceres_ed/util/status.h>

#include <array>
#include <string>

namespace ceres_ed {

// How a run tells how far it is.
enum class ProgressStyle { kBar, kJson, kNone };

constexpr std::array<NamedValue<ProgressStyle>, 3> NamesOf(ProgressStyle) {
  return {{{"bar", ProgressStyle::kBar},
           {"json", ProgressStyle::kJson},
           {"none", ProgressStyle::kNone}}};
}

// What the command line asks for: the run, and what the program shows of it.
struct SlamCommand : SlamSettings {
  ProgressStyle progress = ProgressStyle::kBar;
  bool quiet = false;
};

// Returns the flags as they are now, checked. Error: names the flag, its value and what was
// expected.
StatusOr<SlamCommand> ReadSlamFlags();

// Return a line `--name=value` for each flag that must stay when a run is resumed, and for each
// that may change but is noted then (ResumeRule).
std::string FixedFlags();
std::string StrategyFlags();

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SLAM_FLAGS_H_
