#include "ceres_ed/evaluation/pair_evaluation.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/geometry/closest_point.h>
#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/topology.h>
#include <ceres_ed/geometry/triangle_area.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr double kTrimmedShare = 0.8;
constexpr double kDegenerateShare = 0.05;
constexpr int kBareNeighbors = 6;
constexpr double kDegreesPerRadian = 180.0 / 3.14159265358979323846;

double Percentile(const std::vector<double>& sorted, double percent) {
  if (sorted.empty()) return 0.0;
  const double rank = percent / 100.0 * static_cast<double>(sorted.size() - 1);
  const std::size_t below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (rank - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

DistanceStatistics Symmetric(const DistanceStatistics& a, const DistanceStatistics& b) {
  DistanceStatistics both;
  both.mean = 0.5 * (a.mean + b.mean);
  both.rms = std::sqrt(0.5 * (a.rms * a.rms + b.rms * b.rms));
  both.p50 = 0.5 * (a.p50 + b.p50);
  both.p95 = 0.5 * (a.p95 + b.p95);
  both.p99 = 0.5 * (a.p99 + b.p99);
  both.max = std::max(a.max, b.max);
  both.trimmed = 0.5 * (a.trimmed + b.trimmed);
  return both;
}

std::vector<double> NearestDistances(const std::vector<Eigen::Vector3d>& points,
                                     const KdTree& tree) {
  std::vector<double> distances;
  distances.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    distances.push_back(std::sqrt(tree.Nearest(point).squared_distance));
  }
  return distances;
}

using Edge = std::pair<int, int>;

// Returns each edge once, with the lower index first. On bare points the edges go to the nearest
// neighbours.
std::vector<Edge> EdgesOf(const PointCloud& source,
                          const std::vector<std::array<int, 3>>& triangles) {
  std::vector<Edge> edges;
  for (const auto& t : triangles) {
    for (int k = 0; k < 3; ++k) edges.push_back(std::minmax({t[k], t[(k + 1) % 3]}));
  }
  if (triangles.empty()) {
    const KdTree tree(source.points);
    std::vector<Neighbor> neighbors;
    for (int p = 0; p < static_cast<int>(source.size()); ++p) {
      tree.KNearest(source.points[p], kBareNeighbors + 1, &neighbors);
      int left = kBareNeighbors;
      for (const Neighbor& neighbor : neighbors) {
        if (neighbor.index == p || left-- == 0) continue;
        edges.push_back(std::minmax({p, neighbor.index}));
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

// Returns, for each point, the rotation that best maps its edges to those of the result (Kabsch).
std::vector<Eigen::Matrix3d> BestRotations(const PointCloud& source,
                                           const PointCloud& result,
                                           const std::vector<Edge>& edges) {
  std::vector<Eigen::Matrix3d> rotations(source.size(), Eigen::Matrix3d::Zero());
  for (const auto& [a, b] : edges) {
    const Eigen::Matrix3d product =
        (source.points[a] - source.points[b]) * (result.points[a] - result.points[b]).transpose();
    rotations[a] += product;
    rotations[b] += product;
  }
  for (Eigen::Matrix3d& rotation : rotations) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(rotation,
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d v = svd.matrixV();
    if (svd.matrixU().determinant() * v.determinant() < 0.0) v.col(2) = -v.col(2);
    rotation = v * svd.matrixU().transpose();
  }
  return rotations;
}

// Returns normals that are weighted by triangle area and shared by points at the same position. On
// a damaged result, slivers must not dominate sound triangles, which can happen with weights by
// angle. Returns the cloud's own normals if it has no triangles, and nothing if it has neither.
std::vector<Eigen::Vector3d> NormalsOf(const PointCloud& cloud) {
  if (!cloud.HasTriangles()) {
    return cloud.HasNormals() ? cloud.normals : std::vector<Eigen::Vector3d>();
  }
  const std::vector<int> representative = WeldPoints(cloud.points);
  std::vector<Eigen::Vector3d> sums(cloud.size(), Eigen::Vector3d::Zero());
  for (const auto& t : cloud.triangles) {
    const Eigen::Vector3d area = AreaVector(cloud.points, t);
    for (const int corner : t) sums[representative[corner]] += area;
  }
  std::vector<Eigen::Vector3d> normals;
  normals.reserve(cloud.size());
  // A zero vector stays zero.
  for (const int point : representative) normals.push_back(sums[point].normalized());
  return normals;
}

void CompareNormals(const PointCloud& result,
                    const PointCloud& target,
                    const KdTree& target_tree,
                    Evaluation* evaluation) {
  const std::vector<Eigen::Vector3d> target_normals = NormalsOf(target);
  if (target_normals.empty()) return;
  const std::vector<Eigen::Vector3d> result_normals = NormalsOf(result);
  const bool is_signed = (result.HasTriangles() || result.normals_oriented) &&
                         (target.HasTriangles() || target.normals_oriented);
  double plane_sum = 0.0;
  double angle_sum = 0.0;
  for (std::size_t p = 0; p < result.size(); ++p) {
    const int q = target_tree.Nearest(result.points[p]).index;
    plane_sum += std::abs((result.points[p] - target.points[q]).dot(target_normals[q]));
    if (result_normals.empty()) continue;
    const double cosine = std::clamp(result_normals[p].dot(target_normals[q]), -1.0, 1.0);
    angle_sum += std::acos(is_signed ? cosine : std::abs(cosine));
  }
  const double count = static_cast<double>(result.size());
  evaluation->point_to_plane = plane_sum / count;
  if (!result_normals.empty()) {
    evaluation->normal_error_deg = angle_sum / count * kDegreesPerRadian;
  }
}

Status CheckCloud(const std::string& name, const PointCloud& cloud) {
  if (cloud.empty()) return Status::Error("the " + name + " has no points; expected at least one");
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    if (!cloud.points[p].allFinite()) {
      return Status::Error("point " + std::to_string(p) + " of the " + name +
                           " is not finite; expected numbers");
    }
  }
  return Status::Ok();
}

Status CheckCounterpart(const std::string& name, const PointCloud& cloud, std::size_t count) {
  if (cloud.size() != count) {
    return Status::Error("the " + name + " has " + std::to_string(cloud.size()) +
                         " points and the result " + std::to_string(count) +
                         "; expected the same points in the same order");
  }
  return CheckCloud(name, cloud);
}

}  // namespace

DistanceStatistics DistanceStatistics::InPercentOf(double diagonal) const {
  const double scale = diagonal > 0.0 ? 100.0 / diagonal : 1.0;
  DistanceStatistics scaled = *this;
  for (double* value : {&scaled.mean,
                        &scaled.rms,
                        &scaled.p50,
                        &scaled.p95,
                        &scaled.p99,
                        &scaled.max,
                        &scaled.trimmed}) {
    *value *= scale;
  }
  return scaled;
}

DistanceStatistics Summarize(std::vector<double> distances) {
  DistanceStatistics statistics;
  if (distances.empty()) return statistics;
  std::sort(distances.begin(), distances.end());
  const std::size_t kept =
      std::max<std::size_t>(1, static_cast<std::size_t>(kTrimmedShare * distances.size()));
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t k = 0; k < distances.size(); ++k) {
    sum += distances[k];
    squares += distances[k] * distances[k];
    if (k + 1 == kept) statistics.trimmed = sum / static_cast<double>(kept);
  }
  statistics.mean = sum / static_cast<double>(distances.size());
  statistics.rms = std::sqrt(squares / static_cast<double>(distances.size()));
  statistics.p50 = Percentile(distances, 50.0);
  statistics.p95 = Percentile(distances, 95.0);
  statistics.p99 = Percentile(distances, 99.0);
  statistics.max = distances.back();
  return statistics;
}

std::vector<double> SurfaceDistances(const std::vector<Eigen::Vector3d>& points,
                                     const PointCloud& cloud) {
  CHECK(!cloud.empty());
  std::vector<double> distances = NearestDistances(points, KdTree(cloud.points));
  if (!cloud.HasTriangles()) return distances;
  const SurfaceIndex surface(cloud);
  for (std::size_t p = 0; p < points.size(); ++p) {
    distances[p] = std::min(distances[p], std::sqrt(surface.Closest(points[p]).squared_distance));
  }
  return distances;
}

std::vector<double> PointDistances(const PointCloud& result, const PointCloud& truth) {
  CHECK_EQ(result.size(), truth.size());
  std::vector<double> distances;
  distances.reserve(result.size());
  for (std::size_t p = 0; p < result.size(); ++p) {
    distances.push_back((result.points[p] - truth.points[p]).norm());
  }
  return distances;
}

ShapeChange MeasureShapeChange(const PointCloud& source, const PointCloud& result) {
  CHECK_EQ(source.size(), result.size());
  const auto& triangles = source.HasTriangles() ? source.triangles : result.triangles;
  const std::vector<Edge> edges = EdgesOf(source, triangles);
  std::vector<double> changes;
  for (const auto& [a, b] : edges) {
    const double before = (source.points[a] - source.points[b]).norm();
    if (before == 0.0) continue;
    changes.push_back(std::abs((result.points[a] - result.points[b]).norm() / before - 1.0));
  }
  std::sort(changes.begin(), changes.end());
  ShapeChange change;
  change.edges = static_cast<int>(changes.size());
  for (const double value : changes) change.edge_mean += value / static_cast<double>(change.edges);
  change.edge_p95 = Percentile(changes, 95.0);
  change.edge_p99 = Percentile(changes, 99.0);
  if (triangles.empty()) return change;
  const std::vector<Eigen::Matrix3d> rotations = BestRotations(source, result, edges);
  for (const auto& t : triangles) {
    const Eigen::Vector3d before = AreaVector(source.points, t);
    const Eigen::Vector3d after = AreaVector(result.points, t);
    const Eigen::Vector3d expected = (rotations[t[0]] + rotations[t[1]] + rotations[t[2]]) * before;
    if (expected.dot(after) < 0.0) ++change.flipped;
    if (after.norm() < kDegenerateShare * before.norm()) ++change.degenerate;
  }
  return change;
}

StatusOr<Evaluation> Evaluate(const PointCloud& result,
                              const PointCloud& target,
                              const PointCloud* source,
                              const PointCloud* truth) {
  if (Status status = CheckCloud("result", result); !status.ok()) return status;
  if (Status status = CheckCloud("target", target); !status.ok()) return status;
  for (const auto& [name, cloud] : {std::pair("source", source), std::pair("truth", truth)}) {
    if (cloud == nullptr) continue;
    if (Status status = CheckCounterpart(name, *cloud, result.size()); !status.ok()) return status;
  }
  // If the source was a mesh, a result of bare points is a mesh as well.
  PointCloud surface = result;
  if (!result.HasTriangles() && source != nullptr) surface.triangles = source->triangles;
  Evaluation evaluation;
  evaluation.diagonal = Diagonal(target.points);
  evaluation.forward = Summarize(SurfaceDistances(surface.points, target));
  evaluation.backward = Summarize(SurfaceDistances(target.points, surface));
  evaluation.symmetric = Symmetric(evaluation.forward, evaluation.backward);
  const KdTree target_tree(target.points);
  const KdTree result_tree(surface.points);
  evaluation.nearest_forward = Summarize(NearestDistances(surface.points, target_tree));
  evaluation.nearest_backward = Summarize(NearestDistances(target.points, result_tree));
  CompareNormals(surface, target, target_tree, &evaluation);
  if (truth != nullptr) evaluation.truth = Summarize(PointDistances(result, *truth));
  if (source != nullptr) evaluation.shape = MeasureShapeChange(*source, surface);
  return evaluation;
}

}  // namespace ceres_ed
