// A run of ed_slam over the frames of a sequence, from the first one or from a checkpoint.
#ifndef CERES_ED_APPS_SLAM_SESSION_H_
#define CERES_ED_APPS_SLAM_SESSION_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/slam/checkpoint.h>
#include <ceres_ed/slam/slam.h>
#include <ceres_ed/slam/tracked_points.h>
#include <ceres_ed/util/timer.h>

#include <memory>
#include <string>
#include <vector>

#include <apps/slam_flags.h>
#include <apps/slam_frames.h>
#include <apps/slam_output.h>
#include <apps/slam_reader.h>
#include <apps/slam_report.h>
#include <apps/slam_warnings.h>
#include <apps/support/program.h>

namespace ceres_ed {

// Reads, tracks and writes frame by frame. What it refers to must outlive it.
class SlamSession {
 public:
  // `clock` runs since the start of the program.
  SlamSession(const SlamCommand& settings,
              const std::string& sequence_path,
              const DepthSequence& sequence,
              const EnergyRegistry& registry,
              DeformableSlam* slam,
              const Timer& clock)
      : settings_(settings),
        sequence_path_(sequence_path),
        sequence_(sequence),
        registry_(registry),
        reader_(sequence, settings.options.num_threads),
        slam_(slam),
        clock_(clock) {}

  // Opens the output folder, or, with --resume, goes back to where its checkpoint stands. `points`
  // are to be followed. Anything but done ends the program.
  Outcome Start(std::vector<NamedPoint> points, WarningLog* warnings);

  // Takes all frames in and writes everything.
  Outcome Run();

 private:
  // Reads the next frame, takes it in and writes its row.
  Outcome TakeFrame();
  void CheckDepth(const DepthImage& depth);
  Outcome Track(const DepthFrame& frame, int index, FrameRecord* record);
  // Writes everything as it is and returns how the run ended.
  Outcome Finish(Outcome outcome);
  SlamRun MakeRun() const;
  Status WriteResults(const SlamRun& run) const;

  Status WriteCheckpoint();
  Outcome Resume(const std::string& path);
  // What a checkpoint's sequence must have in common with this one: the camera, the numbers of the
  // frames that are behind us, and the depth of the last of them.
  std::string FramesKey() const;
  // Saves what goes on from frame to frame, but the files, or loads it.
  void ExchangeProgress(CheckpointArchive* archive);

  const SlamCommand& settings_;
  const std::string& sequence_path_;
  const DepthSequence& sequence_;
  const EnergyRegistry& registry_;
  FrameReader reader_;
  DeformableSlam* slam_;
  const Timer& clock_;
  WarningLog* warnings_ = nullptr;
  std::unique_ptr<SlamOutput> output_;
  // Until there is a map to bind them to.
  std::vector<NamedPoint> points_;
  TrackedPoints tracked_;
  std::vector<FrameRecord> records_;
  // Index of the next frame.
  int next_ = 0;
  // Of the depth of the last frame; empty where it could not be read.
  std::string depth_key_;
  double seconds_before_ = 0.0;
  bool depth_checked_ = false;
};

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SLAM_SESSION_H_
