#include "ceres_ed/evaluation/sequence_files.h"

#include <ceres_ed/evaluation/layout_truth.h>
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/results/live_cloud_io.h>
#include <ceres_ed/io/results/trajectory_txt.h>

#include <filesystem>
#include <utility>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

std::string Join(const std::string& folder, const char* name) {
  return (fs::path(folder) / name).string();
}

// Returns whether a folder has truth to compare with but no pictures.
bool HasPosesAndNoPictures(const std::string& folder) {
  std::error_code ignored;
  const bool has_depth = fs::is_directory(Join(folder, "depth"), ignored) &&
                         !fs::is_empty(Join(folder, "depth"), ignored);
  return !has_depth && fs::exists(Join(folder, "camera.txt")) &&
         fs::exists(Join(folder, "poses.txt"));
}

Status OpenPictures(const std::string& folder, SequenceFiles* files) {
  if (HasPosesAndNoPictures(folder)) {
    const StatusOr<CameraFile> camera = ReadCameraFile(Join(folder, "camera.txt"));
    if (camera.ok()) files->camera = camera->camera;
    return camera.status();
  }
  SequenceOptions options;
  options.color = false;
  options.masks = false;
  StatusOr<std::unique_ptr<DepthSource>> opened = OpenDepthSource(folder, options, StereoOptions());
  if (!opened.ok()) return opened.status();
  files->pictures = *std::move(opened);
  const DepthSource& pictures = *files->pictures;
  files->camera = pictures.camera();
  for (int i = 0; i < pictures.num_frames(); ++i) {
    files->index_of_frame[pictures.frame_number(i)] = i;
    const CameraPose* pose = pictures.given_pose(i);
    if (pose != nullptr) files->true_poses[pictures.frame_number(i)] = *pose;
  }
  return Status::Ok();
}

// Adds the poses of poses.txt, which may include frames without a picture.
Status AddPoses(const std::string& path, SequenceFiles* files) {
  const StatusOr<std::vector<FramePose>> poses = ReadPosesFile(path);
  if (!poses.ok()) return poses.status();
  for (const FramePose& pose : *poses) files->true_poses[pose.frame] = pose.world_from_camera;
  return Status::Ok();
}

}  // namespace

bool SequenceFiles::HasFrame(int frame) const {
  return pictures == nullptr ? true_poses.count(frame) > 0 : index_of_frame.count(frame) > 0;
}

std::map<double, int> SequenceFiles::FramesByTime() const {
  std::map<double, int> frames;
  if (pictures == nullptr) {
    for (const auto& [frame, pose] : true_poses) frames[frame] = frame;
    return frames;
  }
  for (const auto& [frame, index] : index_of_frame) frames[pictures->time_s(index)] = frame;
  return frames;
}

StatusOr<std::optional<DepthImage>> SequenceFiles::LoadDepth(
    int frame, std::vector<std::string>* warnings) const {
  const auto index = index_of_frame.find(frame);
  if (index == index_of_frame.end()) return std::optional<DepthImage>();
  FrameProblem problem = FrameProblem::kNone;
  StatusOr<DepthFrame> loaded = pictures->Load(index->second, &problem);
  if (loaded.ok()) return std::optional<DepthImage>(std::move(loaded->depth));
  if (problem == FrameProblem::kWrongSize) return loaded.status();
  warnings->push_back(loaded.status().message() + "; its frame has no residual");
  return std::optional<DepthImage>();
}

StatusOr<SequenceFiles> OpenSequenceFiles(const std::string& folder) {
  SequenceFiles files;
  Status status = OpenPictures(folder, &files);
  if (!status.ok()) return status;
  const std::string poses = Join(folder, "poses.txt");
  const bool has_truth = HoldsSceneTruth(folder);
  // A truth of the tissue is only useful in camera frames.
  if (fs::exists(poses) || (has_truth && files.true_poses.empty())) {
    status = AddPoses(poses, &files);
    if (!status.ok()) return status;
  }
  if (has_truth) {
    StatusOr<SceneTruth> truth = ReadSceneTruth(folder, files.true_poses);
    if (!truth.ok()) return truth.status();
    files.truth = *std::move(truth);
  }
  const std::string tracks_path = Join(folder, "tracks_2d.csv");
  if (fs::exists(tracks_path)) {
    StatusOr<std::vector<TrackObservation>> tracks = ReadPictureTracks(tracks_path);
    if (!tracks.ok()) return tracks.status();
    files.tracks = *std::move(tracks);
  } else if (files.pictures != nullptr) {
    StatusOr<std::vector<TrackObservation>> tracks =
        ReadLayoutTracks(folder, *files.pictures, &files.warnings);
    if (!tracks.ok()) return tracks.status();
    files.tracks = *std::move(tracks);
  }
  if (!files.index_of_frame.empty()) {
    StatusOr<std::map<int, ScanPoints>> scans = ReadScans(
        folder, files.index_of_frame.begin()->first, files.index_of_frame.rbegin()->first);
    if (!scans.ok()) return scans.status();
    files.scans = *std::move(scans);
  }
  StatusOr<std::optional<StirPoints>> end_points = ReadStirPoints(folder);
  if (!end_points.ok()) return end_points.status();
  files.end_points = *std::move(end_points);
  return StatusOr<SequenceFiles>(std::move(files));
}

StatusOr<ResultFiles> LoadResultFiles(const std::string& folder,
                                      const std::string& sequence_folder,
                                      const SequenceFiles& sequence) {
  ResultFiles files;
  const std::string live_folder = Join(folder, "live");
  StatusOr<std::map<int, std::string>> live_paths = ListLiveClouds(live_folder);
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
  const std::string trajectory_path = Join(folder, "trajectory.txt");
  if (fs::exists(trajectory_path)) {
    StatusOr<std::map<int, CameraPose>> trajectory =
        ReadTrajectoryByFrame(trajectory_path, sequence.FramesByTime(), &files.warnings);
    if (!trajectory.ok()) return trajectory.status();
    files.trajectory = *std::move(trajectory);
  }
  const std::string log_path = Join(folder, "frames.csv");
  if (fs::exists(log_path)) {
    StatusOr<FrameLog> log = ReadFrameLog(log_path);
    if (!log.ok()) return log.status();
    files.log = *std::move(log);
  }
  return files;
}

}  // namespace ceres_ed
