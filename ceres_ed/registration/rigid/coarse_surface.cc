#include "ceres_ed/registration/rigid/coarse_surface.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/geometry/triangle_area.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <Eigen/Geometry>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

// A side with less than this share of the weight of the heaviest side of a cube is noise.
constexpr double kLeastShare = 0.25;
// The radius within which normals are summed, in units of the spacing.
constexpr double kNormalReach = 2.0;

struct Patch {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  double weight = 0.0;
  bool on_border = false;
};

// Returns the area vector of each point, averaged along the edges `passes` times; for bare points
// its normal. Averaging along edges does not mix the two sides of a thin body.
std::vector<Eigen::Vector3d> AreaVectors(const Surface& surface, int passes) {
  const PointCloud& cloud = surface.cloud();
  const SurfaceTopology& topology = surface.topology();
  if (!cloud.HasTriangles()) return cloud.normals;
  std::vector<Eigen::Vector3d> areas(cloud.size(), Eigen::Vector3d::Zero());
  for (const std::array<int, 3>& t : cloud.triangles) {
    const Eigen::Vector3d area = AreaVector(cloud.points, t);
    for (const int corner : t) areas[topology.representative[corner]] += area;
  }
  std::vector<Eigen::Vector3d> spread(areas.size());
  for (int pass = 0; pass < passes; ++pass) {
    for (int p = 0; p < static_cast<int>(areas.size()); ++p) {
      const SurfaceLinks edges = topology.Edges(p);
      Eigen::Vector3d sum = areas[p];
      for (const SurfaceLink& edge : edges) sum += areas[edge.to];
      spread[p] = sum / (edges.size() + 1);
    }
    areas.swap(spread);
  }
  return areas;
}

// Returns the points sorted by their cube; within a cube they keep the order of the samples.
std::vector<std::pair<std::array<std::int64_t, 3>, int>> SortByCube(const Surface& surface,
                                                                    double spacing) {
  const std::vector<Eigen::Vector3d>& points = surface.cloud().points;
  const Eigen::Vector3d corner = BoundingBox(points).min();
  std::vector<std::pair<std::array<std::int64_t, 3>, int>> cubes;
  cubes.reserve(points.size());
  for (const int point : SamplePoints(surface, static_cast<int>(points.size()))) {
    std::array<std::int64_t, 3> cube;
    for (int axis = 0; axis < 3; ++axis) {
      cube[axis] = static_cast<std::int64_t>((points[point][axis] - corner[axis]) / spacing);
    }
    cubes.emplace_back(cube, point);
  }
  std::stable_sort(
      cubes.begin(), cubes.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return cubes;
}

}  // namespace

double MedianNormalTurn(const Surface& surface) {
  constexpr int kTurnSamples = 300;
  const std::vector<Eigen::Vector3d>& normals = surface.cloud().normals;
  std::vector<double> cosines;
  for (const int point : SamplePoints(surface, kTurnSamples)) {
    for (const SurfaceLink& edge : surface.topology().Edges(point)) {
      cosines.push_back(normals[point].dot(normals[edge.to]));
    }
  }
  if (cosines.empty()) return 0.0;
  return std::acos(std::clamp(Median(std::move(cosines)), -1.0, 1.0));
}

CoarseSurface::CoarseSurface(const Surface& surface, double spacing, int passes) : tree_(points_) {
  CHECK_GT(spacing, 0.0);
  const PointCloud& cloud = surface.cloud();
  const std::vector<Eigen::Vector3d> areas = AreaVectors(surface, passes);
  const auto cubes = SortByCube(surface, spacing);
  std::vector<Eigen::Vector3d> patch_areas;
  std::vector<Patch> patches;
  const auto flush = [&] {
    double heaviest = 0.0;
    for (const Patch& patch : patches) heaviest = std::max(heaviest, patch.weight);
    for (const Patch& patch : patches) {
      if (patch.weight < kLeastShare * heaviest) continue;
      points_.push_back(patch.sum / patch.weight);
      patch_areas.push_back(patch.area);
      is_border_.push_back(static_cast<char>(patch.on_border));
    }
    patches.clear();
  };
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    if (i > 0 && cubes[i].first != cubes[i - 1].first) flush();
    const int point = cubes[i].second;
    Eigen::Vector3d area = areas[point];
    auto patch = std::find_if(patches.begin(), patches.end(), [&](const Patch& p) {
      return !cloud.normals_oriented || p.area.dot(area) >= 0.0;
    });
    if (patch == patches.end()) patch = patches.insert(patch, Patch());
    if (!cloud.normals_oriented && patch->area.dot(area) < 0.0) area = -area;
    const double weight = surface.relative_areas()[point];
    patch->sum += weight * cloud.points[point];
    patch->area += area;
    patch->weight += weight;
    patch->on_border |= surface.topology().is_border[point] != 0;
  }
  flush();
  tree_ = KdTree(points_);
  normals_.resize(points_.size());
  std::vector<Neighbor> around;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    tree_.RadiusSearch(points_[i], kNormalReach * spacing, &around);
    for (const Neighbor& neighbor : around) {
      const Eigen::Vector3d& area = patch_areas[neighbor.index];
      const double side = area.dot(patch_areas[i]);
      if (side > 0.0) sum += area;
      if (side < 0.0 && !cloud.normals_oriented) sum -= area;
    }
    const double norm = sum.norm();
    normals_[i] = norm > 0.0 ? Eigen::Vector3d(sum / norm) : Eigen::Vector3d::Zero();
  }
}

}  // namespace ceres_ed
