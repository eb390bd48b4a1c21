// A run over the frames of a sequence, which begins at the first frame or at a checkpoint.
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
#include <ceres_ed/stereo/depth_source.h>
#include <ceres_ed/util/timer.h>

#include <memory>
#include <string>
#include <vector>

namespace ceres_ed {

// Reads, tracks and writes frame by frame. The objects to which it refers must outlive it.
class SlamSession {
 public:
  // `clock` must have been started with the program.
  SlamSession(const SlamSettings& settings,
              const DepthSource& sequence,
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

  // Opens the output folder or, to resume, returns to the state of its checkpoint. `points` are the
  // points to follow. The run ends unless the outcome is done.
  Outcome Start(std::vector<NamedPoint> points);

  // Processes all frames and writes the results.
  Outcome Run();

 private:
  // Processes the remaining frames until one ends the run.
  Outcome TakeFrames();
  // Reads and processes the next frame, and writes its row.
  Outcome TakeFrame();
  // Stores the fingerprint of the depth, and warns if the first depth image has an unlikely range.
  void CheckDepth(const DepthFrame& frame);
  // Fills in what is known of the comparison of stereo pictures.
  void NoteStereo(const DepthFrame& frame, FrameRecord* record) const;
  // Tracks the frame, fills in its record, and writes everything but its row.
  Outcome Track(const DepthFrame& frame, int index, FrameRecord* record);
  // Removes the points of a challenge that are too far from the map, with a warning for each.
  void DropPointsOffTheMap();
  // Writes the results and returns how the run ended.
  Outcome End(Outcome outcome);
  SlamRun MakeRun() const;
  Status WriteResults(const SlamRun& run) const;

  Status WriteCheckpoint();
  Outcome Resume(const std::string& path);
  // Returns what the sequence of a checkpoint must have in common with this one: the camera, the
  // numbers of the processed frames, and the depth of the last of them.
  std::string FramesKey() const;
  // Saves or loads everything that is kept from frame to frame, except the files.
  void ExchangeProgress(CheckpointArchive* archive);

  const SlamSettings& settings_;
  const DepthSource& sequence_;
  const EnergyRegistry& registry_;
  FrameReader reader_;
  DeformableSlam* slam_;
  WarningLog* warnings_;
  SlamObserver* observer_;
  const Timer& clock_;
  std::unique_ptr<SlamOutput> output_;
  // The points to follow, until there is a map to which they are bound.
  std::vector<NamedPoint> points_;
  TrackedPoints tracked_;
  std::vector<FrameRecord> records_;
  // The index of the next frame.
  int next_ = 0;
  // The fingerprint of the last frame's depth; empty if the frame could not be read.
  std::string depth_key_;
  // The reason for an early end, as reports have it.
  std::string stop_status_;
  // The time of the earlier parts of a resumed run.
  double seconds_before_ = 0.0;
  bool depth_checked_ = false;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_SLAM_SESSION_H_
