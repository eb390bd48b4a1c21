// The flags of ed_slam.
#ifndef CERES_ED_APPS_SLAM_FLAGS_H_
#define CERES_ED_APPS_SLAM_FLAGS_H_

#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/slam/slam.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// How a run tells how far it is.
enum class ProgressStyle { kBar, kJson, kNone };

// What the command line asks for. Paths are empty where a flag is not given.
struct SlamSettings {
  SlamOptions options;
  SequenceOptions sequence;
  std::string output;
  std::string track;
  std::string plugin;
  // Every n-th frame leaves a live cloud, or a checkpoint; 0 = none.
  int live_every = 1;
  int checkpoint_every = 10;
  bool resume = false;
  // Seconds; infinite without a limit.
  double time_limit_s = 0.0;
  ProgressStyle progress = ProgressStyle::kBar;
  bool quiet = false;
};

// Returns the flags as they are now, checked. Error: names the flag, its value and what was
// expected.
StatusOr<SlamSettings> ReadSlamFlags();

// Return a line `--name=value` for each flag that a run is resumed with as it was, and for each
// that says how the levels are solved: these may change on the way, the map is the same in kind.
std::string FixedFlags();
std::string StrategyFlags();

// "batch" or "two_level"; "estimate", "fixed" or "given".
std::string SlamModeName(SolveMode mode);
std::string CameraModeName(CameraMode mode);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SLAM_FLAGS_H_
