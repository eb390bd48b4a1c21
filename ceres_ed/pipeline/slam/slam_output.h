// The folder that a run fills.
#ifndef CERES_ED_PIPELINE_SLAM_SLAM_OUTPUT_H_
#define CERES_ED_PIPELINE_SLAM_SLAM_OUTPUT_H_

#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/io/append_file.h>
#include <ceres_ed/pipeline/slam/frame_records.h>
#include <ceres_ed/slam/checkpoint.h>
#include <ceres_ed/slam/slam.h>
#include <ceres_ed/slam/tracked_points.h>
#include <ceres_ed/util/status.h>

#include <memory>
#include <string>

namespace ceres_ed {

inline constexpr char kReportName[] = "report.json";
inline constexpr char kCheckpointName[] = "checkpoint.cbor";

// What is written of a frame.
struct FrameOutput {
  // When it was taken, seconds.
  double time_s = 0.0;
  bool live = true;
  // Null: no points are followed.
  const TrackedPoints* tracked = nullptr;
};

// Whether a folder has the result of a run that has come to its end, or to a limit: nothing that
// should be lost without a word.
bool HoldsResult(const std::string& directory);

// frames.csv, trajectory.txt, tracks.csv and live/ grow frame by frame; map.ply and graph.ply are
// made anew when asked for. Whatever ends the program, every file is whole and every row complete.
class SlamOutput {
 public:
  // Makes the folder where it is missing, and empties it of what an earlier run has left there:
  // files of these names, no others. Error: names the path and the system's reason.
  static StatusOr<std::unique_ptr<SlamOutput>> Create(const std::string& directory,
                                                      const PinholeCamera& camera);

  // Goes on in a folder as `archive` knows it: rows behind those of the checkpoint are dropped.
  static StatusOr<std::unique_ptr<SlamOutput>> Reopen(const std::string& directory,
                                                      const PinholeCamera& camera,
                                                      CheckpointArchive* archive);

  // Writes what belongs to a frame: nothing where its camera is not known. The row of frames.csv is
  // for WriteRecord().
  Status WriteFrame(const FrameRecord& record,
                    const DeformableSlam& slam,
                    const FrameOutput& options);

  // Appends the row to frames.csv: to be called last, so that what it tells of is there.
  Status WriteRecord(const FrameRecord& record);

  // Writes map.ply (the map as it is now, map frame, metres) and graph.ply (the same of the nodes).
  Status WriteMap(const DeformableSlam& slam) const;

  // Saves how much of each growing file there is, for Reopen().
  void Save(CheckpointArchive* archive) const;

  // "DIR/name".
  std::string Path(const std::string& name) const { return directory_ + "/" + name; }

 private:
  SlamOutput(const std::string& directory, const PinholeCamera& camera)
      : directory_(directory), camera_(camera) {}

  Status WriteTracks(int frame, const DeformableSlam& slam, const TrackedPoints& tracked);

  std::string directory_;
  PinholeCamera camera_;
  AppendFile frames_;
  AppendFile trajectory_;
  // Opened with its first row.
  AppendFile tracks_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_SLAM_OUTPUT_H_
