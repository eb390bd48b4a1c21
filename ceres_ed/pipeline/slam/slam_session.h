// A run over the frames of a sequence, from the first one or from a checkpoint.
#ifndef CERES_ED_PIPELINE_SLAM_SLAM_SESSION_H_
#define CERES_ED_PIPELINE_SLAM_SLAM_SESSION_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/pipeline/outcome.h>
#include <ceres_ed/pipeline/slam/frame_reader.h>
#include <ceres_ed/pipeline/slam/frame_records.h>
#include <ceres_ed/pipeline/slam/slam_observer.h>
#include <ceres_ed/pipeline/slam/slam_output.h>
#include <ceres_ed/pipeline/slam/slam_settings.h>
#include <ceres_ed/pipeline/slam/warning_log.h>
#include <ceres_ed/slam/checkpoint.h>
#include <ceres_ed/slam/slam.h>
#include <ceres_ed/slam/tracked_points.h>
#include <ceres_ed/util/timer.h>

#include <memory>
#include <string>
#include <vector>

namespace ceres_ed {

// Reads, tracks and writes frame by frame. What it refers to must outlive it.
class SlamSession {
 public:
  // `clock` runs since the start of the program.
  SlamSession(const SlamSettings& settings,
              const DepthSequence& sequence,
              const EnergyRegistry& registry,
              DeformableSlam* slam,
              WarningLog* warnings,
              SlamObserver* observer,
              const Timer& clock)
      : settings_(settings),
        sequence_(sequence),
        registry_(registry),
        reader_(sequence, settings.options.num_threads),
        slam_(slam),
        warnings_(warnings),
        observer_(observer),
        clock_(clock) {}

  // Opens the output folder, or, to resume, goes back to where its checkpoint stands. `points` are
  // to be followed. Anything but done ends the run.
  Outcome Start(std::vector<NamedPoint> points);

  // Takes all frames in and writes everything.
  Outcome Run();

 private:
  // Takes the frames that are left, until one ends the run.
  Outcome TakeFrames();
  // Reads the next frame, takes it in and writes its row.
  Outcome TakeFrame();
  void CheckDepth(const DepthImage& depth);
  Outcome Track(const DepthFrame& frame, int index, FrameRecord* record);
  // Writes everything as it is and returns how the run ended.
  Outcome End(Outcome outcome);
  SlamRun MakeRun() const;
  Status WriteResults(const SlamRun& run) const;

  Status WriteCheckpoint();
  Outcome Resume(const std::string& path);
  // What a checkpoint's sequence must have in common with this one: the camera, the numbers of the
  // frames that are behind us, and the depth of the last of them.
  std::string FramesKey() const;
  // Saves what goes on from frame to frame, but the files, or loads it.
  void ExchangeProgress(CheckpointArchive* archive);

  const SlamSettings& settings_;
  const DepthSequence& sequence_;
  const EnergyRegistry& registry_;
  FrameReader reader_;
  DeformableSlam* slam_;
  WarningLog* warnings_;
  SlamObserver* observer_;
  const Timer& clock_;
  std::unique_ptr<SlamOutput> output_;
  // Until there is a map to bind them to.
  std::vector<NamedPoint> points_;
  TrackedPoints tracked_;
  std::vector<FrameRecord> records_;
  // Index of the next frame.
  int next_ = 0;
  // The fingerprint of the last frame's depth; empty if that could not be read.
  std::string depth_key_;
  // Why the run was stopped early, as reports have it.
  std::string stop_status_;
  double seconds_before_ = 0.0;
  bool depth_checked_ = false;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_SLAM_SESSION_H_
