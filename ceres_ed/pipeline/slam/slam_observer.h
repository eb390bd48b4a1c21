// What tracking of a sequence tells its caller.
#ifndef CERES_ED_PIPELINE_SLAM_SLAM_OBSERVER_H_
#define CERES_ED_PIPELINE_SLAM_SLAM_OBSERVER_H_

#include <ceres_ed/io/results/frames_csv.h>
#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/pipeline/run_observer.h>
#include <ceres_ed/pipeline/slam/slam_settings.h>
#include <ceres_ed/slam/slam.h>

#include <string>
#include <vector>

namespace ceres_ed {

// A run as far as it has come. None of the pointers is null.
struct SlamRun {
  const SlamSettings* settings = nullptr;
  const DepthSequence* sequence = nullptr;
  const DeformableSlam* slam = nullptr;
  const std::vector<FrameRecord>* records = nullptr;
  const std::vector<std::string>* warnings = nullptr;
  // "running" (a checkpoint), "done", "time_limit", "interrupted" or "failed".
  std::string status;
  std::string message;
  // Since the start of the program, and of all parts of a run that was resumed.
  double total_s = 0.0;
};

// As of RunObserver, and frame by frame.
class SlamObserver : public RunObserver {
 public:
  // A frame was taken in; `done` of `total` are behind us, at `frames_per_s` of this part of the
  // run.
  virtual void OnFrame(const FrameRecord& /*record*/,
                       int /*done*/,
                       int /*total*/,
                       double /*frames_per_s*/) {}

  // The run has ended, and its results are written.
  virtual void OnEnd(const SlamRun& /*run*/) {}
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_SLAM_OBSERVER_H_
