// Writes the depth of a stereo sequence to disk.
#ifndef CERES_ED_PIPELINE_DEPTH_DEPTH_RUN_H_
#define CERES_ED_PIPELINE_DEPTH_DEPTH_RUN_H_

#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/pipeline/outcome.h>
#include <ceres_ed/pipeline/run_flag.h>
#include <ceres_ed/pipeline/run_observer.h>
#include <ceres_ed/stereo/stereo_options.h>

#include <string>

namespace ceres_ed {

struct DepthSettings {
  SequenceOptions sequence;
  StereoOptions stereo;
  // The folder of the sequence.
  std::string input;
  // The folder that is written.
  std::string output;
  // Whether a sequence that is already in `output` is replaced.
  bool overwrite = false;
  // The number of stored depth units in a metre; 0: the largest power of ten with which twice the
  // depth of the first frame can be stored.
  double units_per_metre = 0.0;
  // The flags for info.json. Paths, `overwrite` and `quiet` are left out of it.
  RunFlags flags;
};

// What was written.
struct WrittenDepth {
  int frames = 0;
  // Frames whose pictures cannot be read.
  int skipped = 0;
  int width = 0;
  int height = 0;
  double units_per_metre = 0.0;
  // The medians over the frames: the share of pixels with depth, the depth in metres, and the
  // seconds for comparing a pair (NaN for images of depth).
  double valid_share = 0.0;
  double depth = 0.0;
  double stereo_s = 0.0;
};

// A RunObserver that also receives what was written.
class DepthObserver : public RunObserver {
 public:
  virtual void OnEnd(const WrittenDepth& /*written*/) {}
};

// Writes the native layout (camera.txt, depth/, color/, mask/ if there are masks, poses.txt if
// there are poses) with the numbers of the frames of the sequence, the truth of the sequence if it
// has any in files of the native layout, and info.json. The camera is the rectified left one.
// Returns how the run ended: no result if no pair could be read.
Outcome RunDepth(const DepthSettings& settings, DepthObserver* observer);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_DEPTH_DEPTH_RUN_H_
