#include "ceres_ed/pipeline/report/slam_run_files.h"

#include <ceres_ed/evaluation/sequence_evaluation.h>
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/mesh/vertex_columns.h>
#include <ceres_ed/io/sequence/scene_truth.h>
#include <ceres_ed/report/html/report_json.h>
#include <ceres_ed/report/view/sequence_view.h>
#include <ceres_ed/stereo/depth_source.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>

namespace ceres_ed {
namespace {

// Returns whole numbers of a column at the rows of the points; all are `otherwise` without it.
std::vector<int> NumbersOf(const LoadedCloud& loaded, const char* name, int otherwise) {
  const PlyProperty* const property = loaded.document.Find("vertex")->Find(name);
  std::vector<int> numbers(loaded.cloud.size(), otherwise);
  if (property == nullptr || property->is_list) return numbers;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    constexpr double kMost = 1e9;
    const double value = property->values[static_cast<std::size_t>(loaded.vertex_of_point[i])];
    if (value >= 0.0 && value <= kMost) numbers[i] = static_cast<int>(value);
  }
  return numbers;
}

std::vector<double> ValuesOf(const LoadedCloud& loaded, const char* name) {
  const PlyProperty* const property = loaded.document.Find("vertex")->Find(name);
  std::vector<double> values;
  if (property == nullptr || property->is_list) return values;
  for (const int row : loaded.vertex_of_point) {
    values.push_back(property->values[static_cast<std::size_t>(row)]);
  }
  return values;
}

class SlamRunFiles {
 public:
  SlamRunFiles(const FinishedRun& run, const std::string& sequence, bool with_truth)
      : run_(run), sequence_path_(sequence), with_truth_(with_truth) {}

  SlamRunView Read();

 private:
  void Miss(const std::string& what, const std::string& reason) {
    missing_.push_back("The " + what + " not shown: " + reason + ".");
  }
  // Returns the path of a file of the run.
  std::string Path(const std::string& name) const {
    return (std::filesystem::path(run_.path).parent_path() / name).string();
  }
  bool Exists(const std::string& name) const {
    std::error_code error;
    return std::filesystem::exists(Path(name), error);
  }
  void ReadCamera();
  void ReadLog();
  void ReadPath();
  void ReadMap();
  void ReadDeviations();
  void ReadTracksFile();
  void ReadMoments();
  void OpenPictures();
  void ReadPictures();
  void MeasureTruth();

  const FinishedRun& run_;
  std::string sequence_path_;
  bool with_truth_;
  SequenceParts parts_;
  std::unique_ptr<DepthSource> pictures_;
  std::map<int, int> index_of_frame_;
  std::vector<MomentError> errors_;
  int live_clouds_ = 0;
  std::vector<std::string> missing_;
};

void SlamRunFiles::ReadCamera() {
  const nlohmann::ordered_json& sequence = MemberOf(run_.report, {"sequence"});
  PinholeCamera& camera = parts_.camera;
  const auto number = [&sequence](const char* name, double otherwise) {
    const double value = NumberOf(sequence, {name});
    constexpr double kMost = 1e5;
    return value > 0.0 && value < kMost ? value : otherwise;
  };
  camera.width = static_cast<int>(number("width", 640.0));
  camera.height = static_cast<int>(number("height", 480.0));
  camera.fx = number("fx", camera.width);
  camera.fy = number("fy", camera.fx);
  camera.cx = number("cx", 0.5 * camera.width);
  camera.cy = number("cy", 0.5 * camera.height);
  if (sequence_path_.empty()) sequence_path_ = TextOf(sequence, {"path"});
}

void SlamRunFiles::ReadLog() {
  StatusOr<FrameLog> log = ReadFrameLog(Path("frames.csv"));
  if (!log.ok()) return Miss("frames are", log.status().message());
  parts_.log = *std::move(log);
}

// The rows of trajectory.txt are the frames whose camera is known, in their order.
void SlamRunFiles::ReadPath() {
  const StatusOr<std::vector<TimedPose>> poses = ReadTrajectory(Path("trajectory.txt"));
  if (!poses.ok()) return Miss("path of the camera is", poses.status().message());
  std::vector<int> frames;
  for (std::size_t i = 0; i < parts_.log.frames.size(); ++i) {
    const std::string& status = parts_.log.statuses[i];
    if (status != "lost" && status != "skipped") frames.push_back(parts_.log.frames[i]);
  }
  // A run that was stopped may have written a pose before the row of its frame.
  const std::size_t known = std::min(frames.size(), poses->size());
  if (poses->size() > known + 1 || frames.size() > known) {
    return Miss("path of the camera is",
                "trajectory.txt has " + std::to_string(poses->size()) + " poses, and frames.csv " +
                    std::to_string(frames.size()) + " frames whose camera is known");
  }
  for (std::size_t i = 0; i < known; ++i) {
    const CameraPose& pose = (*poses)[i].world_from_camera;
    if (pose.translation.cwiseAbs().maxCoeff() > kMaxCoordinate) continue;
    parts_.map_from_camera.emplace(frames[i], pose);
  }
}

void SlamRunFiles::ReadMap() {
  const StatusOr<LoadedCloud> loaded = LoadCloud(Path("map.ply"));
  if (!loaded.ok()) return Miss("map at its end is", loaded.status().message());
  MapSnapshot& map = parts_.map;
  map.points = loaded->cloud.points;
  map.normals = loaded->cloud.normals;
  map.normals.resize(map.points.size(), Eigen::Vector3d::Zero());
  map.ids = NumbersOf(*loaded, "id", -1);
  map.birth_frames = NumbersOf(*loaded, "birth_frame", 0);
  map.last_seen = NumbersOf(*loaded, "last_seen", 0);
  map.stabilities = ValuesOf(*loaded, "stability");
  map.colors.assign(map.points.size(), {0, 0, 0});
  const PlyElement& vertices = *loaded->document.Find("vertex");
  if (const auto columns = FindColorColumns(vertices)) {
    for (std::size_t i = 0; i < map.points.size(); ++i) {
      const auto row = static_cast<std::size_t>(loaded->vertex_of_point[i]);
      const Eigen::Vector3d color = RowOf(vertices, *columns, row);
      constexpr double kMost = 255.0;
      for (std::size_t c = 0; c < 3; ++c) {
        const double part = color[static_cast<Eigen::Index>(c)];
        map.colors[i][c] =
            std::isfinite(part) ? static_cast<std::uint8_t>(std::clamp(part, 0.0, kMost)) : 0;
      }
    }
    // Without pictures all points have one grey.
    parts_.has_color = MemberOf(run_.report, {"sequence", "color"}) == true &&
                       MemberOf(run_.report, {"flags", "color"}) != false;
  }
}

void SlamRunFiles::ReadDeviations() {
  if (!Exists("map_covariance.ply")) return;
  const StatusOr<LoadedCloud> loaded = LoadCloud(Path("map_covariance.ply"));
  if (!loaded.ok()) return Miss("uncertainty is", loaded.status().message());
  const std::vector<int> ids = NumbersOf(*loaded, "id", -1);
  const std::vector<double> values = ValuesOf(*loaded, "std_dev");
  std::unordered_map<int, double> of_id;
  for (std::size_t i = 0; i < values.size(); ++i) of_id.emplace(ids[i], values[i]);
  for (const int id : parts_.map.ids) {
    const auto found = of_id.find(id);
    parts_.std_dev.push_back(found == of_id.end() ? -1.0 : found->second);
  }
}

void SlamRunFiles::ReadTracksFile() {
  if (!Exists("tracks.csv")) return;
  StatusOr<std::vector<TrackPlace>> tracks = ReadTracks(Path("tracks.csv"));
  if (!tracks.ok()) return Miss("tracks are", tracks.status().message());
  parts_.tracks = *std::move(tracks);
}

void SlamRunFiles::ReadMoments() {
  const StatusOr<std::map<int, std::string>> live = ListLiveClouds(Path("live"));
  if (!live.ok()) Miss("live clouds are", live.status().message());
  std::vector<int> frames, with_cloud;
  for (const auto& [frame, pose] : parts_.map_from_camera) {
    frames.push_back(frame);
    if (live.ok() && live->count(frame) > 0) with_cloud.push_back(frame);
  }
  live_clouds_ = static_cast<int>(with_cloud.size());
  if (with_cloud.empty()) {
    for (const int frame : ChooseMoments(frames)) parts_.moments.push_back({frame, {}, {}, {}});
    return;
  }
  std::vector<std::string> warnings;
  for (const int frame : ChooseMoments(with_cloud)) {
    StatusOr<LiveSnapshot> cloud = ReadLiveCloud(live->at(frame), frame, &warnings);
    if (cloud.ok() && !cloud->points.empty()) {
      parts_.moments.push_back({frame, *std::move(cloud), {}, {}});
    } else if (!cloud.ok()) {
      Miss("live cloud is", cloud.status().message());
    }
  }
}

void SlamRunFiles::OpenPictures() {
  if (sequence_path_.empty()) return;
  SequenceOptions options;
  options.masks = false;
  const std::string format = TextOf(run_.report, {"flags", "format"});
  if (const auto known = FindByName<SequenceFormat>(format)) options.format = *known;
  StereoOptions stereo;
  stereo.check = false;
  StatusOr<std::unique_ptr<DepthSource>> opened =
      OpenDepthSource(run_.Find(sequence_path_), options, stereo);
  if (!opened.ok()) return Miss("pictures are", opened.status().message());
  pictures_ = *std::move(opened);
  for (int i = 0; i < pictures_->num_frames(); ++i) {
    index_of_frame_.emplace(pictures_->frame_number(i), i);
  }
}

void SlamRunFiles::ReadPictures() {
  const auto color = MemberOf(run_.report, {"flags", "color"});
  if (pictures_ == nullptr || !pictures_->has_color() || color == false) return;
  for (SequenceMoment& moment : parts_.moments) {
    const auto index = index_of_frame_.find(moment.frame);
    if (index == index_of_frame_.end()) continue;
    moment.picture = ShrinkPicture(pictures_->LoadPicture(index->second));
  }
}

// Compares the points of the moments with the truth.
void SlamRunFiles::MeasureTruth() {
  const std::string folder = run_.Find(sequence_path_);
  if (!with_truth_ || pictures_ == nullptr || !HoldsSceneTruth(folder)) return;
  std::map<int, CameraPose> poses;
  for (int i = 0; i < pictures_->num_frames(); ++i) {
    const CameraPose* const pose = pictures_->given_pose(i);
    if (pose != nullptr) poses.emplace(pictures_->frame_number(i), *pose);
  }
  const StatusOr<SceneTruth> truth = ReadSceneTruth(folder, poses);
  if (!truth.ok()) return Miss("errors are", truth.status().message());
  TruthEvaluator evaluator(parts_.camera, *truth);
  for (SequenceMoment& moment : parts_.moments) {
    if (moment.cloud.points.empty()) return;
    StatusOr<std::vector<double>> errors = evaluator.TrackingErrors(moment.cloud);
    if (!errors.ok()) return Miss("errors are", errors.status().message());
    moment.errors = *std::move(errors);
    std::vector<double> known;
    for (const double error : moment.errors) {
      if (std::isfinite(error)) known.push_back(error);
    }
    if (known.empty()) continue;
    const DistanceStatistics statistics = Summarize(std::move(known));
    errors_.push_back({moment.frame, statistics.mean, statistics.p50, statistics.p95});
  }
}

SlamRunView SlamRunFiles::Read() {
  ReadCamera();
  ReadLog();
  ReadPath();
  ReadMap();
  ReadDeviations();
  ReadTracksFile();
  ReadMoments();
  SlamRunView result;
  SequenceView& view = result.view;
  if (!parts_.moments.empty()) {
    OpenPictures();
    ReadPictures();
    MeasureTruth();
    view.scene = MakeSequenceScene(parts_);
  }
  view.log = std::move(parts_.log);
  view.errors = std::move(errors_);
  view.live_clouds = live_clouds_;
  std::vector<std::string>& notes = view.scene.notes;
  notes.insert(notes.begin(), missing_.begin(), missing_.end());
  result.missing = std::move(missing_);
  return result;
}

}  // namespace

SlamRunView ReadSlamRun(const FinishedRun& run, const std::string& sequence, bool with_truth) {
  return SlamRunFiles(run, sequence, with_truth).Read();
}

}  // namespace ceres_ed
