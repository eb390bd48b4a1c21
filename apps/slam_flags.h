// The flags of ed_slam.
#ifndef CERES_ED_APPS_SLAM_FLAGS_H_
#define CERES_ED_APPS_SLAM_FLAGS_H_

#include <ceres_ed/pipeline/slam/slam_settings.h>
#include <ceres_ed/util/named_values.h>
#include <ceres_ed/util/status.h>

#include <array>
#include <string>

namespace ceres_ed {

// How a run shows its progress.
enum class ProgressStyle { kBar, kJson, kNone };

constexpr std::array<NamedValue<ProgressStyle>, 3> NamesOf(ProgressStyle) {
  return {{{"bar", ProgressStyle::kBar},
           {"json", ProgressStyle::kJson},
           {"none", ProgressStyle::kNone}}};
}

// The settings on the command line: those of the run, and those of what the program shows.
struct SlamCommand : SlamSettings {
  ProgressStyle progress = ProgressStyle::kBar;
  bool quiet = false;
};

// Returns the settings in the flags after checking them. The error names the flag, its value and
// what was expected.
StatusOr<SlamCommand> ReadSlamFlags();

// Return a line `--name=value` for each flag that must not change when a run is resumed, and for
// each flag that may change but whose change is reported (ResumeRule).
std::string FixedFlags();
std::string StrategyFlags();

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SLAM_FLAGS_H_
