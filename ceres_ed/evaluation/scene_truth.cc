#include "ceres_ed/evaluation/scene_truth.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {

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

TrueSurface::TrueSurface(PointCloud mesh) : mesh_(std::move(mesh)), index_(mesh_) {
  CHECK(mesh_.HasTriangles());
}

double TrueSurface::Distance(const Eigen::Vector3d& point) const {
  return std::sqrt(index_.Closest(point).squared_distance);
}

TissuePoint TrueSurface::Locate(const Eigen::Vector3d& point, double max_distance) const {
  const SurfaceHit hit = index_.Closest(point, max_distance);
  return {hit.triangle, hit.barycentric};
}

Eigen::Vector3d TrueSurface::PlaceOf(const TissuePoint& tissue) const {
  CHECK(tissue.known());
  const auto& [a, b, c] = mesh_.triangles[static_cast<std::size_t>(tissue.triangle)];
  return tissue.barycentric[0] * mesh_.points[a] + tissue.barycentric[1] * mesh_.points[b] +
         tissue.barycentric[2] * mesh_.points[c];
}

}  // namespace ceres_ed
