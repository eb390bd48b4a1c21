// What tracking of a sequence on disk is asked to do.
#ifndef CERES_ED_PIPELINE_SLAM_SLAM_SETTINGS_H_
#define CERES_ED_PIPELINE_SLAM_SLAM_SETTINGS_H_

#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/pipeline/run_flag.h>
#include <ceres_ed/slam/slam_options.h>

#include <limits>
#include <string>

namespace ceres_ed {

// Paths are empty where a file is not given.
struct SlamSettings {
  SlamOptions options;
  SequenceOptions sequence;
  // The folder of the sequence.
  std::string input;
  // The folder to write.
  std::string output;
  // A PLY of points to follow, in the camera frame of the first frame, metres.
  std::string track;
  // Shared objects with more energies, several with ";" between them.
  std::string plugin;
  // Every n-th frame leaves a live cloud, or a checkpoint; 0 = none.
  int live_every = 1;
  int checkpoint_every = 10;
  // Whether to go on from the checkpoint in `output`, if there is one.
  bool resume = false;
  // Whether to replace a finished result that is in `output`.
  bool overwrite = false;
  // Seconds.
  double time_limit_s = std::numeric_limits<double>::infinity();
  // For the report.
  RunFlags flags;
  // A line `--name=value` for each flag that a run must be resumed with as it was, and for each
  // that says how the levels are solved: these may change on the way, the map is the same in kind.
  std::string fixed_flags;
  std::string strategy_flags;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_SLAM_SETTINGS_H_
