#include "ceres_ed/evaluation/true_surface.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {

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
