// The output folder of the tracking of a sequence.
#ifndef CERES_ED_PIPELINE_SLAM_SLAM_OUTPUT_H_
#define CERES_ED_PIPELINE_SLAM_SLAM_OUTPUT_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/io/append_file.h>
#include <ceres_ed/pipeline/slam/frame_records.h>
#include <ceres_ed/slam/checkpoint.h>
#include <ceres_ed/slam/slam.h>
#include <ceres_ed/slam/tracked_points.h>
#include <ceres_ed/util/status.h>

#include <memory>
#include <string>

#include <Eigen/Core>

namespace ceres_ed {

inline constexpr char kReportName[] = "report.json";
inline constexpr char kCheckpointName[] = "checkpoint.cbor";

// What is written for a frame.
struct FrameOutput {
  // The time of the frame in seconds.
  double time_s = 0.0;
  // Whether a live cloud is written.
  bool live = true;
  // The pixels that show tissue; null if they are not written.
  const MaskImage* mask = nullptr;
  // The points that are followed; null if there are none.
  const TrackedPoints* tracked = nullptr;
  // The covariance of the camera (FrameReport); null if there is none.
  const Eigen::Matrix<double, 6, 6>* camera_covariance = nullptr;
};

// Returns whether a folder has the result of a run that has ended or reached a limit, which must
// not be replaced unless the user asks for it. A report that cannot be understood counts as a
// result.
bool HoldsResult(const std::string& directory);

// Writes the output of a run. frames.csv, trajectory.txt, tracks.csv, camera_covariance.csv and
// live/ grow frame by frame; WriteMap() replaces map.ply, map_covariance.ply and graph.ply.
// Whenever the program ends, even if it is killed, all files and rows are complete.
class SlamOutput {
 public:
  // Creates the folder if it does not exist, and removes the files that an earlier run has left in
  // it, but no files of other names. Symbolic links of such names are removed, not what they point
  // to. The error names the path and gives the system's reason.
  static StatusOr<std::unique_ptr<SlamOutput>> Create(const std::string& directory,
                                                      const PinholeCamera& camera);

  // Continues in a folder from the state that `archive` has saved. Rows that were written after the
  // checkpoint are removed. It is an error if a file with rows is a symbolic link; other links are
  // removed as by Create().
  static StatusOr<std::unique_ptr<SlamOutput>> Reopen(const std::string& directory,
                                                      const PinholeCamera& camera,
                                                      CheckpointArchive* archive);

  // Writes the live cloud, the mask, the rows of tracks.csv and the row of trajectory.txt for a
  // frame, or nothing if its camera is not known. WriteRecord() writes the row of frames.csv.
  Status WriteFrame(const FrameRecord& record,
                    const DeformableSlam& slam,
                    const FrameOutput& options);

  // Appends the row to frames.csv. Call it last, so that a row exists only if the files of its
  // frame do.
  Status WriteRecord(const FrameRecord& record);

  // Writes map.ply (the current map, in the map frame and in metres) and graph.ply (its nodes, in
  // the same frame and unit), and map_covariance.ply if `with_covariances`.
  Status WriteMap(const DeformableSlam& slam, bool with_covariances) const;

  // Saves the size of each growing file, for Reopen().
  void Save(CheckpointArchive* archive) const;

  // Returns "DIR/name".
  std::string Path(const std::string& name) const { return directory_ + "/" + name; }

 private:
  SlamOutput(const std::string& directory, const PinholeCamera& camera)
      : directory_(directory), camera_(camera) {}

  Status WriteMask(int frame, const MaskImage& mask) const;
  Status WriteCovariance(int frame, const Eigen::Matrix<double, 6, 6>& camera);
  Status WriteTracks(int frame, const DeformableSlam& slam, const TrackedPoints& tracked);

  std::string directory_;
  PinholeCamera camera_;
  AppendFile frames_;
  AppendFile trajectory_;
  // These files are created when their first rows are written.
  AppendFile tracks_;
  AppendFile covariance_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_SLAM_SLAM_OUTPUT_H_
