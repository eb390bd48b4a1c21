// The settings of the tracking of a sequence on disk.
#ifndef CERES_ED_PIPELINE_SLAM_SLAM_SETTINGS_H_
#define CERES_ED_PIPELINE_SLAM_SLAM_SETTINGS_H_

#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/pipeline/run_flag.h>
#include <ceres_ed/report/picture/theme.h>
#include <ceres_ed/slam/slam_options.h>
#include <ceres_ed/stereo/stereo_options.h>
#include <ceres_ed/util/named_values.h>

#include <array>
#include <limits>
#include <string>

namespace ceres_ed {

// The challenge whose files are written (challenge.h).
enum class Challenge { kNone, kStir, kSurgT };

constexpr std::array<NamedValue<Challenge>, 3> NamesOf(Challenge) {
  return {{{"none", Challenge::kNone}, {"stir", Challenge::kStir}, {"surgt", Challenge::kSurgT}}};
}

// A path is empty if the file is not given.
struct SlamSettings {
  SlamOptions options;
  SequenceOptions sequence;
  StereoOptions stereo;
  // The folder of the sequence.
  std::string input;
  // The folder that is written.
  std::string output;
  // The page and the picture of the run, and the surface of its map.
  std::string html;
  std::string png;
  Theme theme = Theme::kLight;
  std::string mesh;
  // A PLY file of points to follow, in the camera frame of the first frame, in metres.
  std::string track;
  // The challenge whose points are followed, in the place of `track`, and whose files are written.
  Challenge predict = Challenge::kNone;
  // Shared objects with more energies, separated by ";".
  std::string plugin;
  // A live cloud is written every `live_every` frames, and a checkpoint every `checkpoint_every`
  // frames; 0 = never.
  int live_every = 1;
  // Whether a mask of the tissue is written for each frame.
  bool write_masks = false;
  int checkpoint_every = 10;
  // Whether the run continues from the checkpoint in `output`, if there is one.
  bool resume = false;
  // Whether a finished result in `output` is replaced.
  bool overwrite = false;
  // The time limit in seconds.
  double time_limit_s = std::numeric_limits<double>::infinity();
  // The flags of the program, for the report.
  RunFlags flags;
  // Lines `--name=value`: the flags that must not change when a run is resumed, and the flags that
  // say how the levels are solved. The latter may change, since the map remains of the same kind.
  std::string fixed_flags;
  std::string strategy_flags;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_SLAM_SETTINGS_H_
