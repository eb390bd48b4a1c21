#include "ceres_ed/io/results/trajectory_txt.h"

#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/text_rows.h>

namespace ceres_ed {

std::string TrajectoryHeader() {
  return "# timestamp tx ty tz qx qy qz qw, camera to map, seconds and metres\n";
}

std::string TrajectoryRow(double time_s, const CameraPose& map_from_camera) {
  const Eigen::Vector3d& t = map_from_camera.translation;
  const Eigen::Quaterniond& q = map_from_camera.rotation;
  std::string row;
  AppendNumbers({time_s, t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}, &row);
  return row + "\n";
}

StatusOr<std::map<int, CameraPose>> ReadTrajectoryByFrame(const std::string& path,
                                                          const std::map<double, int>& frame_at,
                                                          std::vector<std::string>* warnings) {
  const StatusOr<std::vector<TimedPose>> poses = ReadTrajectory(path);
  if (!poses.ok()) return poses.status();
  std::map<int, CameraPose> by_frame;
  for (const TimedPose& pose : *poses) {
    const auto frame = frame_at.find(pose.time_s);
    if (frame == frame_at.end()) {
      warnings->push_back(path + ": time " + std::to_string(pose.time_s) +
                          ", expected that of a frame of the sequence; the camera is not measured");
      return std::map<int, CameraPose>();
    }
    by_frame[frame->second] = pose.world_from_camera;
  }
  return by_frame;
}

}  // namespace ceres_ed
