#include "apps/eval_result_files.h"

#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/mesh/vertex_columns.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <unordered_set>
#include <utility>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

// The trajectory by frames, without those that are none.
std::map<int, CameraPose> PosesByFrame(const std::vector<TimedPose>& poses,
                                       const std::string& path,
                                       std::vector<std::string>* warnings) {
  std::map<int, CameraPose> by_frame;
  for (const TimedPose& pose : poses) {
    const double time = pose.time_s;
    if (time != std::floor(time) || time < 0.0 || time > std::numeric_limits<int>::max()) {
      warnings->push_back(path + ": time " + std::to_string(time) +
                          ", expected frame numbers; the camera is not measured");
      return {};
    }
    by_frame[static_cast<int>(time)] = pose.world_from_camera;
  }
  return by_frame;
}

// The column `name` of whole numbers >= 0 at the rows of the points.
StatusOr<std::vector<int>> WholeColumn(const std::string& path,
                                       const LoadedCloud& loaded,
                                       const char* name) {
  const PlyProperty* const property = loaded.document.Find("vertex")->Find(name);
  if (property == nullptr || property->is_list) {
    return Status::Error(path + ": no property '" + name +
                         "', expected the vertex properties id, birth_frame, bx, by, bz");
  }
  std::vector<int> column;
  column.reserve(loaded.vertex_of_point.size());
  for (const int row : loaded.vertex_of_point) {
    const double value = property->values[static_cast<std::size_t>(row)];
    if (!(value >= 0.0 && value <= std::numeric_limits<int>::max()) || value != std::floor(value)) {
      return Status::Error(path + ": vertex " + std::to_string(row) + ": " + name + " is " +
                           std::to_string(value) + ", expected a whole number >= 0");
    }
    column.push_back(static_cast<int>(value));
  }
  return column;
}

}  // namespace

StatusOr<ResultFiles> LoadResultFiles(const std::string& folder,
                                      const std::string& sequence_folder,
                                      const SequenceFiles& sequence) {
  ResultFiles files;
  const std::string live_folder = (fs::path(folder) / "live").string();
  StatusOr<std::map<int, std::string>> live_paths = NumberedFiles(live_folder, ".ply");
  if (!live_paths.ok()) return live_paths.status();
  files.live_paths = *std::move(live_paths);
  if (files.live_paths.empty()) {
    return Status::Error(live_folder + ": no live clouds, expected NNNNNN.ply as ed_slam writes");
  }
  for (const auto& [frame, path] : files.live_paths) {
    if (sequence.HasFrame(frame)) continue;
    return Status::Error(path + ": " + sequence_folder + " has no frame " + std::to_string(frame) +
                         ", expected the sequence that the result was made of");
  }
  const std::string trajectory_path = (fs::path(folder) / "trajectory.txt").string();
  if (fs::exists(trajectory_path)) {
    const StatusOr<std::vector<TimedPose>> poses = ReadTrajectory(trajectory_path);
    if (!poses.ok()) return poses.status();
    files.trajectory = PosesByFrame(*poses, trajectory_path, &files.warnings);
  }
  const std::string log_path = (fs::path(folder) / "frames.csv").string();
  if (fs::exists(log_path)) {
    StatusOr<FrameLog> log = ReadFrameLog(log_path);
    if (!log.ok()) return log.status();
    files.log = *std::move(log);
  }
  return files;
}

StatusOr<LiveSnapshot> LoadLiveSnapshot(const std::string& path,
                                        int frame,
                                        std::vector<std::string>* warnings) {
  StatusOr<LoadedCloud> loaded = LoadCloud(path);
  if (!loaded.ok()) return loaded.status();
  for (const std::string& warning : loaded->warnings) warnings->push_back(path + ": " + warning);
  StatusOr<std::vector<int>> ids = WholeColumn(path, *loaded, "id");
  if (!ids.ok()) return ids.status();
  StatusOr<std::vector<int>> birth_frames = WholeColumn(path, *loaded, "birth_frame");
  if (!birth_frames.ok()) return birth_frames.status();
  const PlyElement& vertices = *loaded->document.Find("vertex");
  const auto columns = FindColumns(vertices, {"bx", "by", "bz"});
  if (!columns) {
    return Status::Error(path + ": no properties bx by bz, expected where each point was at birth");
  }
  LiveSnapshot snapshot;
  snapshot.frame = frame;
  std::unordered_set<int> seen;
  for (std::size_t i = 0; i < loaded->cloud.size(); ++i) {
    const int row = loaded->vertex_of_point[i];
    snapshot.birth_points.push_back(RowOf(vertices, *columns, static_cast<std::size_t>(row)));
    if (!snapshot.birth_points.back().allFinite()) {
      return Status::Error(path + ": vertex " + std::to_string(row) +
                           ": bx by bz are not finite, expected numbers");
    }
    if (!seen.insert((*ids)[i]).second) {
      return Status::Error(path + ": vertex " + std::to_string(row) + ": id " +
                           std::to_string((*ids)[i]) + " is there twice, expected it once");
    }
  }
  snapshot.points = std::move(loaded->cloud.points);
  snapshot.ids = *std::move(ids);
  snapshot.birth_frames = *std::move(birth_frames);
  return snapshot;
}

}  // namespace ceres_ed
