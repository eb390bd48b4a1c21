#include "ceres_ed/evaluation/scan_truth.h"

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/visibility_buffer.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/json_file.h>
#include <ceres_ed/io/pose_matrix.h>
#include <ceres_ed/util/statistics.h>

#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

bool IsRegularFile(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

// Returns the entry of clips.json with this name; null if there is none.
nlohmann::json ClipNamed(const nlohmann::json& file, const std::string& name) {
  const auto clips = file.is_object() ? file.find("clips") : file.end();
  if (!file.is_object() || clips == file.end() || !clips->is_array()) return nullptr;
  for (const nlohmann::json& clip : *clips) {
    if (clip.is_object() && clip.value("name", nlohmann::json()) == name) return clip;
  }
  return nullptr;
}

// Reads a scan and turns it into the frame of the camera.
StatusOr<ScanPoints> ReadScan(const std::string& path, const std::string& pose_path) {
  const StatusOr<LoadedCloud> cloud = LoadCloud(path);
  if (!cloud.ok()) return cloud.status();
  const StatusOr<CameraPose> pose = ReadPoseMatrix(pose_path, 1.0);
  if (!pose.ok()) return pose.status();
  ScanPoints points;
  std::vector<double> distances;
  for (const Eigen::Vector3d& point : cloud->cloud.points) {
    points.push_back(pose->rotation.conjugate() * (point - pose->translation));
    distances.push_back(points.back().norm());
  }
  if (points.empty()) {
    return Status::Error(path + ": no points, expected a scan of the tissue");
  }
  constexpr double kFarthestMetres = 5.0;
  constexpr double kMetresPerMillimetre = 1e-3;
  if (Median(std::move(distances)) > kFarthestMetres) {
    for (Eigen::Vector3d& point : points) point *= kMetresPerMillimetre;
  }
  return points;
}

}  // namespace

StatusOr<std::map<int, ScanPoints>> ReadScans(const std::string& folder, int first, int last) {
  std::map<int, ScanPoints> scans;
  std::error_code error;
  const fs::path clip = fs::canonical(folder, error);
  const fs::path session = clip.parent_path().parent_path();
  if (error || !IsRegularFile(clip / "curated_camera_pose_start.txt") ||
      !IsRegularFile(session / "clips.json")) {
    return scans;
  }
  const StatusOr<nlohmann::json> file = ReadJsonFile((session / "clips.json").string());
  if (!file.ok()) return file.status();
  const nlohmann::json entry = ClipNamed(*file, clip.filename().string());
  for (const auto& [name, frame] :
       {std::pair(std::string("start"), first), std::pair(std::string("end"), last)}) {
    const fs::path pose = clip / ("curated_camera_pose_" + name + ".txt");
    const auto geometry = entry.is_object() ? entry.find(name + "_geometry") : entry.end();
    if (!entry.is_object() || geometry == entry.end() || !geometry->is_string()) continue;
    const fs::path path = session / geometry->get<std::string>();
    if (!IsRegularFile(pose) || !IsRegularFile(path)) continue;
    StatusOr<ScanPoints> points = ReadScan(path.string(), pose.string());
    if (!points.ok()) return points.status();
    scans[frame] = *std::move(points);
  }
  return scans;
}

ScanAgreement CompareWithScan(const PinholeCamera& camera,
                              const LiveSnapshot& snapshot,
                              const ScanPoints& scan,
                              const SequenceEvaluationOptions& options) {
  VisibilityBuffer buffer(camera);
  buffer.AddPoints(snapshot.points);
  const KdTree tree(scan);
  ScanAgreement agreement;
  agreement.frame = snapshot.frame;
  std::vector<double> distances;
  for (const Eigen::Vector3d& point : snapshot.points) {
    if (!buffer.Sees(point, options.visibility_tolerance)) continue;
    const Neighbor nearest = tree.Nearest(point);
    if (nearest.found()) distances.push_back(std::sqrt(nearest.squared_distance));
  }
  agreement.seen = static_cast<int>(distances.size());
  if (!distances.empty()) agreement.distance = Summarize(distances);
  return agreement;
}

}  // namespace ceres_ed
