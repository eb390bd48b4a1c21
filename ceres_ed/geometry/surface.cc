#include "ceres_ed/geometry/surface.h"

#include <ceres_ed/geometry/normals.h>
#include <ceres_ed/geometry/point_borders.h>
#include <ceres_ed/geometry/triangle_area.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

PointCloud WithNormals(PointCloud cloud, int num_threads) {
  CHECK(!cloud.empty()) << "a surface without points";
  EnsureNormals(&cloud, num_threads);
  return cloud;
}

// Returns the area of each point's share relative to the mean, limited to [0.1, 10].
std::vector<double> RelativeAreas(const PointCloud& cloud) {
  if (!cloud.HasTriangles()) return std::vector<double>(cloud.size(), 1.0);
  std::vector<double> areas(cloud.size(), 0.0);
  double total = 0.0;
  for (const std::array<int, 3>& t : cloud.triangles) {
    const double area = AreaVector(cloud.points, t).norm() / 3.0;
    for (const int corner : t) areas[corner] += area;
    total += 3.0 * area;
  }
  if (total <= 0.0) return std::vector<double>(cloud.size(), 1.0);
  const double mean = total / static_cast<double>(cloud.size());
  for (double& area : areas) area = std::clamp(area / mean, 0.1, 10.0);
  return areas;
}

// Returns the radius of a disc that has the area of each point's share.
std::vector<double> Radii(const PointCloud& cloud) {
  std::vector<double> areas(cloud.size(), 0.0);
  for (const std::array<int, 3>& t : cloud.triangles) {
    const double area = AreaVector(cloud.points, t).norm() / 3.0;
    for (const int corner : t) areas[corner] += area;
  }
  for (double& area : areas) area = std::sqrt(area / M_PI);
  return areas;
}

}  // namespace

Surface::Surface(PointCloud cloud, int num_threads)
    : cloud_(WithNormals(std::move(cloud), num_threads)),
      num_threads_(num_threads),
      relative_areas_(RelativeAreas(cloud_)),
      radii_(Radii(cloud_)) {}

const SurfaceTopology& Surface::topology() const {
  std::call_once(topology_built_, [this] {
    topology_ = BuildTopology(cloud_);
    if (cloud_.HasTriangles()) return;
    topology_.is_border = FindBorderPoints(cloud_.points, cloud_.normals, num_threads_);
  });
  return topology_;
}

const SurfaceIndex& Surface::index() const {
  std::call_once(index_built_, [this] { index_.emplace(cloud_, topology()); });
  return *index_;
}

const KdTree& Surface::tree() const {
  std::call_once(tree_built_, [this] { tree_.emplace(cloud_.points); });
  return *tree_;
}

Eigen::Vector3d Surface::NormalAt(const SurfaceHit& hit) const {
  if (hit.triangle < 0) return cloud_.normals[hit.nearest_vertex];
  const std::array<int, 3>& t = cloud_.triangles[hit.triangle];
  const Eigen::Vector3d blended = hit.barycentric[0] * cloud_.normals[t[0]] +
                                  hit.barycentric[1] * cloud_.normals[t[1]] +
                                  hit.barycentric[2] * cloud_.normals[t[2]];
  const double norm = blended.norm();
  return norm > 0.0 ? Eigen::Vector3d(blended / norm) : Eigen::Vector3d::Zero();
}

Intensity Surface::IntensityAt(const SurfaceHit& hit) const {
  if (!cloud_.HasIntensities() || !hit.found()) return {};
  if (hit.triangle < 0) return IntensityOf(hit.nearest_vertex);
  const std::array<int, 3>& t = cloud_.triangles[hit.triangle];
  const std::array<double, 3> values = {
      cloud_.intensities[t[0]], cloud_.intensities[t[1]], cloud_.intensities[t[2]]};
  const Eigen::Vector3d gradient =
      GradientOnTriangle(cloud_.points[t[0]], cloud_.points[t[1]], cloud_.points[t[2]], values);
  if (!gradient.allFinite()) return {};
  return {hit.barycentric.dot(Eigen::Map<const Eigen::Vector3d>(values.data())), gradient};
}

Intensity Surface::IntensityOf(int point) const {
  if (!cloud_.HasIntensities()) return {};
  std::call_once(gradients_built_, [this] { intensity_gradients_ = IntensityGradients(cloud_); });
  const Eigen::Vector3d& gradient = intensity_gradients_[point];
  if (!gradient.allFinite()) return {};
  return {cloud_.intensities[point], gradient};
}

std::vector<int> SamplePoints(const Surface& surface, int count) {
  const SurfaceTopology& topology = surface.topology();
  std::vector<int> candidates;
  candidates.reserve(topology.walk_order.size());
  for (const int point : topology.walk_order) {
    if (!surface.cloud().HasTriangles() || topology.is_isolated[point] == 0) {
      candidates.push_back(point);
    }
  }
  const int available = static_cast<int>(candidates.size());
  if (available <= count) return candidates;
  std::vector<int> samples;
  samples.reserve(count);
  for (int i = 0; i < count; ++i) {
    samples.push_back(candidates[static_cast<long>(i) * available / count]);
  }
  return samples;
}

}  // namespace ceres_ed
