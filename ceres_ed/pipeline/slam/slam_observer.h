// The observer of the tracking of a sequence.
#ifndef CERES_ED_PIPELINE_SLAM_SLAM_OBSERVER_H_
#define CERES_ED_PIPELINE_SLAM_SLAM_OBSERVER_H_

#include <ceres_ed/io/results/frames_csv.h>
#include <ceres_ed/pipeline/run_observer.h>
#include <ceres_ed/pipeline/slam/slam_settings.h>
#include <ceres_ed/slam/slam.h>
#include <ceres_ed/stereo/depth_source.h>

#include <string>
#include <vector>

namespace ceres_ed {

// The state of a run. None of the pointers is null.
struct SlamRun {
  const SlamSettings* settings = nullptr;
  const DepthSource* sequence = nullptr;
  const DeformableSlam* slam = nullptr;
  const std::vector<FrameRecord>* records = nullptr;
  const std::vector<std::string>* warnings = nullptr;
  // "running" (at a checkpoint), "done", "time_limit", "interrupted" or "failed".
  std::string status;
  std::string message;
  // The seconds since the start of the program, plus those of the earlier parts of a resumed run.
  double total_s = 0.0;
};

// A RunObserver that also receives each frame and the end of the run.
class SlamObserver : public RunObserver {
 public:
  // Called after each frame. `done` of `total` frames are finished; this part of the run processes
  // `frames_per_s`.
  virtual void OnFrame(const FrameRecord& /*record*/,
                       int /*done*/,
                       int /*total*/,
                       double /*frames_per_s*/) {}

  // Called when the run has ended and its results have been written.
  virtual void OnEnd(const SlamRun& /*run*/) {}
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_SLAM_OBSERVER_H_
