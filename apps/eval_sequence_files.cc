#include "apps/eval_sequence_files.h"

#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/text.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include <apps/eval_table_file.h>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxDigits = 9;

bool IsNumber(const std::string& text) {
  return !text.empty() && text.size() <= kMaxDigits &&
         text.find_first_not_of("0123456789") == std::string::npos;
}

// Reads `count` little-endian floats of 32 bits.
Status ReadFloats(std::ifstream* file,
                  const std::string& path,
                  std::size_t count,
                  std::vector<float>* floats) {
  floats->resize(count);
  file->read(reinterpret_cast<char*>(floats->data()), static_cast<std::streamsize>(4 * count));
  if (!*file) return Status::Error(path + ": cannot be read to its end");
  for (std::size_t i = 0; i < count; ++i) {
    unsigned char bytes[4];
    std::memcpy(bytes, &(*floats)[i], 4);
    const std::uint32_t bits = bytes[0] | std::uint32_t{bytes[1]} << 8 |
                               std::uint32_t{bytes[2]} << 16 | std::uint32_t{bytes[3]} << 24;
    std::memcpy(&(*floats)[i], &bits, 4);
    if (!std::isfinite((*floats)[i])) {
      return Status::Error(path + ": number " + std::to_string(i) +
                           " is not finite, expected coordinates");
    }
  }
  return Status::Ok();
}

StatusOr<SceneTruth> LoadTruth(const std::string& mesh_path,
                               const std::string& vertices_path,
                               const std::map<int, CameraPose>& poses) {
  const StatusOr<LoadedCloud> mesh = LoadCloud(mesh_path);
  if (!mesh.ok()) return mesh.status();
  const std::size_t rows = mesh->document.Find("vertex")->count;
  if (mesh->cloud.size() != rows || !mesh->cloud.HasTriangles()) {
    return Status::Error(mesh_path + ": " + std::to_string(mesh->cloud.size()) + " of " +
                         std::to_string(rows) + " vertices are finite and there are " +
                         std::to_string(mesh->cloud.triangles.size()) +
                         " triangles, expected finite vertices with triangles");
  }
  SceneTruth truth;
  truth.triangles = mesh->cloud.triangles;
  truth.num_vertices = static_cast<int>(rows);
  truth.world_from_camera = poses;

  std::ifstream file;
  const StatusOr<std::size_t> size = OpenRegularFile(vertices_path, &file);
  if (!size.ok()) return size.status();
  const std::size_t frame_size = 3 * sizeof(float) * rows;
  const std::size_t num_frames = *size / frame_size;
  const std::size_t expected =
      poses.empty() ? 1 : static_cast<std::size_t>(poses.rbegin()->first) + 1;
  if (*size % frame_size != 0 || num_frames < expected) {
    return Status::Error(vertices_path + ": " + std::to_string(*size) + " bytes, expected " +
                         std::to_string(frame_size) + " (12 for each of " + std::to_string(rows) +
                         " vertices) for each of " + std::to_string(expected) + " frames");
  }
  Status status = ReadFloats(&file, vertices_path, 3 * rows * num_frames, &truth.vertices);
  if (!status.ok()) return status;
  return truth;
}

}  // namespace

bool SequenceFiles::HasFrame(int frame) const {
  return depth_paths.empty() ? true_poses.count(frame) > 0 : depth_paths.count(frame) > 0;
}

StatusOr<std::map<int, std::string>> NumberedFiles(const std::string& folder,
                                                   const std::string& extension) {
  std::map<int, std::string> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const fs::path& path = it->path();
    if (path.extension() != extension || !IsNumber(path.stem().string())) continue;
    const auto [entry, is_new] = files.insert({std::stoi(path.stem().string()), path.string()});
    if (!is_new) {
      return Status::Error(path.string() + ": the same frame as " + entry->second +
                           ", expected one file a frame");
    }
  }
  return files;
}

StatusOr<SequenceFiles> LoadSequenceFiles(const std::string& folder) {
  SequenceFiles files;
  const auto has = [&folder](const char* name) { return fs::exists(fs::path(folder) / name); };
  const auto path = [&folder](const char* name) { return (fs::path(folder) / name).string(); };
  StatusOr<CameraFile> camera = ReadCameraFile(path("camera.txt"));
  if (!camera.ok()) return camera.status();
  files.camera = *camera;
  StatusOr<std::map<int, std::string>> depth_paths = NumberedFiles(path("depth"), ".png");
  if (!depth_paths.ok()) return depth_paths.status();
  files.depth_paths = *std::move(depth_paths);

  const bool has_truth = has("gt_vertices.f32") || has("gt_mesh_000000.ply");
  // A truth of the tissue is of use in camera frames only.
  if (has("poses.txt") || has_truth) {
    const StatusOr<std::vector<FramePose>> poses = ReadPosesFile(path("poses.txt"));
    if (!poses.ok()) return poses.status();
    for (const FramePose& pose : *poses) files.true_poses[pose.frame] = pose.world_from_camera;
  }
  if (files.depth_paths.empty() && files.true_poses.empty()) {
    return Status::Error(folder + ": no depth/NNNNNN.png and no poses, expected one of them");
  }
  if (has_truth) {
    StatusOr<SceneTruth> truth =
        LoadTruth(path("gt_mesh_000000.ply"), path("gt_vertices.f32"), files.true_poses);
    if (!truth.ok()) return truth.status();
    files.truth = *std::move(truth);
  }
  if (has("tracks_2d.csv")) {
    StatusOr<std::vector<TrackObservation>> tracks = ReadPictureTracks(path("tracks_2d.csv"));
    if (!tracks.ok()) return tracks.status();
    files.tracks = *std::move(tracks);
  }
  return files;
}

}  // namespace ceres_ed
