#include "ceres_ed/io/sequence/scene_truth.h"

#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/text.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

static_assert(sizeof(float) == 4, "the file has floats of 32 bits");

// Converts a number between the byte order of this machine and that of the file, in either
// direction.
void ExchangeLittleEndian(float* number) {
  unsigned char bytes[4];
  std::memcpy(bytes, number, 4);
  const std::uint32_t bits = bytes[0] | std::uint32_t{bytes[1]} << 8 |
                             std::uint32_t{bytes[2]} << 16 | std::uint32_t{bytes[3]} << 24;
  std::memcpy(number, &bits, 4);
}

Status ReadFloats(std::ifstream* file,
                  const std::string& path,
                  std::size_t count,
                  std::vector<float>* floats) {
  floats->resize(count);
  file->read(reinterpret_cast<char*>(floats->data()), static_cast<std::streamsize>(4 * count));
  if (!*file) return Status::Error(path + ": cannot be read to its end");
  for (std::size_t i = 0; i < count; ++i) {
    ExchangeLittleEndian(&(*floats)[i]);
    if (!std::isfinite((*floats)[i])) {
      return Status::Error(path + ": number " + std::to_string(i) +
                           " is not finite, expected coordinates");
    }
  }
  return Status::Ok();
}

}  // namespace

int SceneTruth::num_frames() const {
  if (num_vertices == 0) return 0;
  return static_cast<int>(vertices.size() / 3 / static_cast<std::size_t>(num_vertices));
}

bool SceneTruth::Has(int frame) const {
  return frame >= 0 && frame < num_frames() && world_from_camera.count(frame) > 0;
}

PointCloud SceneTruth::InCamera(int frame) const {
  CHECK(Has(frame)) << frame;
  const CameraPose& pose = world_from_camera.at(frame);
  const Eigen::Matrix3d camera_from_world = pose.rotation.toRotationMatrix().transpose();
  PointCloud mesh;
  mesh.triangles = triangles;
  mesh.points.reserve(static_cast<std::size_t>(num_vertices));
  const float* vertex = &vertices[3 * static_cast<std::size_t>(num_vertices) * frame];
  for (int i = 0; i < num_vertices; ++i, vertex += 3) {
    const Eigen::Vector3d in_world(vertex[0], vertex[1], vertex[2]);
    mesh.points.push_back(camera_from_world * (in_world - pose.translation));
  }
  return mesh;
}

bool HoldsSceneTruth(const std::string& folder) {
  return fs::exists(fs::path(folder) / kTruthMeshName) ||
         fs::exists(fs::path(folder) / kTruthVerticesName);
}

StatusOr<SceneTruth> ReadSceneTruth(const std::string& folder,
                                    const std::map<int, CameraPose>& world_from_camera) {
  const std::string mesh_path = (fs::path(folder) / kTruthMeshName).string();
  const std::string vertices_path = (fs::path(folder) / kTruthVerticesName).string();
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
  truth.world_from_camera = world_from_camera;

  std::ifstream file;
  const StatusOr<std::size_t> size = OpenRegularFile(vertices_path, &file);
  if (!size.ok()) return size.status();
  const std::size_t frame_size = 3 * sizeof(float) * rows;
  const std::size_t num_frames = *size / frame_size;
  const std::size_t expected =
      world_from_camera.empty() ? 1
                                : static_cast<std::size_t>(world_from_camera.rbegin()->first) + 1;
  if (*size % frame_size != 0 || num_frames < expected) {
    return Status::Error(vertices_path + ": " + std::to_string(*size) + " bytes, expected " +
                         std::to_string(frame_size) + " (12 for each of " + std::to_string(rows) +
                         " vertices) for each of " + std::to_string(expected) + " frames");
  }
  Status status = ReadFloats(&file, vertices_path, 3 * rows * num_frames, &truth.vertices);
  if (!status.ok()) return status;
  return truth;
}

StatusOr<std::unique_ptr<SceneTruthWriter>> SceneTruthWriter::Create(
    const std::string& folder, std::vector<std::array<int, 3>> triangles) {
  StatusOr<std::unique_ptr<AtomicFile>> file =
      AtomicFile::Create((fs::path(folder) / kTruthVerticesName).string());
  if (!file.ok()) return file.status();
  std::unique_ptr<SceneTruthWriter> writer(new SceneTruthWriter);
  writer->folder_ = folder;
  writer->first_.triangles = std::move(triangles);
  writer->vertices_ = *std::move(file);
  return StatusOr<std::unique_ptr<SceneTruthWriter>>(std::move(writer));
}

Status SceneTruthWriter::Add(const std::vector<Eigen::Vector3d>& points) {
  if (first_.points.empty()) first_.points = points;
  CHECK_EQ(points.size(), first_.points.size());
  buffer_.clear();
  for (const Eigen::Vector3d& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      buffer_.push_back(static_cast<float>(point[axis]));
      ExchangeLittleEndian(&buffer_.back());
    }
  }
  vertices_->stream().write(reinterpret_cast<const char*>(buffer_.data()),
                            static_cast<std::streamsize>(buffer_.size() * sizeof(float)));
  return vertices_->stream().good()
             ? Status::Ok()
             : Status::Error(folder_ + "/" + kTruthVerticesName + ": can't be written, disk full?");
}

Status SceneTruthWriter::Close() {
  CloudWriteOptions options;
  options.comments = {"true surface at frame 0, metres, world frame"};
  Status status = WriteCloud((fs::path(folder_) / kTruthMeshName).string(), first_, options);
  return status.ok() ? vertices_->Commit() : status;
}

}  // namespace ceres_ed
