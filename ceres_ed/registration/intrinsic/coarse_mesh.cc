#include "ceres_ed/registration/intrinsic/coarse_mesh.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/geometry/sampling.h>
#include <ceres_ed/geometry/surface_distance.h>
#include <ceres_ed/geometry/triangle_area.h>
#include <ceres_ed/registration/intrinsic/tangent_triangles.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

// The spacing of the first trial on bare points, as a part of the diagonal; on a mesh, the share of
// the area that the squares of the spacing cover; and the number of trials.
constexpr double kFirstSpacing = 0.04;
constexpr double kCoveredShare = 0.7;
constexpr int kTrials = 4;
// The number of vertices may differ from what was asked by this factor.
constexpr double kCountTolerance = 1.2;
// A trial does not change the spacing by more than the root of this.
constexpr double kLeastRatio = 0.05;
// A part with a smaller share of the area is left out.
constexpr double kLeastArea = 0.05;
// A triangle between bare points occurs once for each of its corners.
constexpr double kPointTriangleWeight = 1.0 / 3.0;
constexpr int kMinVertices = 4;

// Returns points of the surface that are evenly spread, about `count`, and sets their spacing.
std::vector<int> SpreadPoints(const Surface& surface,
                              int count,
                              bool along_surface,
                              double* spacing) {
  const PointCloud& cloud = surface.cloud();
  double trial_spacing =
      along_surface ? std::sqrt(kCoveredShare * SurfaceArea(cloud.points, cloud.triangles) / count)
                    : kFirstSpacing * BoundingBox(cloud.points).diagonal().norm();
  double best = std::numeric_limits<double>::infinity();
  std::vector<int> spread;
  for (int trial = 0; trial < kTrials && trial_spacing > 0.0; ++trial) {
    std::vector<int> chosen = along_surface ? UniformDownsampleAlongSurface(
                                                  surface.topology(), trial_spacing, kMinVertices)
                                            : UniformDownsample(cloud.points, trial_spacing);
    const double ratio = std::max(static_cast<double>(chosen.size()) / count, kLeastRatio);
    const double miss = std::abs(std::log(ratio));
    if (miss < best) {
      best = miss;
      *spacing = trial_spacing;
      spread = std::move(chosen);
    }
    if (best < std::log(kCountTolerance)) break;
    trial_spacing *= std::sqrt(ratio);
  }
  return spread;
}

// Returns the triangles between the cells of `seeds` on a mesh, each once.
std::vector<std::array<int, 3>> CellTriangles(const Surface& surface,
                                              const std::vector<int>& seeds,
                                              const std::function<bool()>& should_stop) {
  const SurfaceTopology& topology = surface.topology();
  const NearestSeeds cells = NearestSeedsAlongSurface(topology, seeds, 1, {}, should_stop);
  std::set<std::array<int, 3>> known;
  std::vector<std::array<int, 3>> triangles;
  for (const std::array<int, 3>& triangle : surface.cloud().triangles) {
    std::array<int, 3> met;
    for (int k = 0; k < 3; ++k) met[k] = cells.SeedsOf(topology.representative[triangle[k]])[0];
    if (met[0] == met[1] || met[1] == met[2] || met[2] == met[0]) continue;
    std::array<int, 3> key = met;
    std::sort(key.begin(), key.end());
    if (key[0] >= 0 && known.insert(key).second) triangles.push_back(met);
  }
  return triangles;
}

// Returns the root of a vertex in a forest of connected vertices, with shortened paths.
int RootOf(int vertex, std::vector<int>* parent) {
  while ((*parent)[vertex] != vertex) {
    (*parent)[vertex] = (*parent)[(*parent)[vertex]];
    vertex = (*parent)[vertex];
  }
  return vertex;
}

double MeanEdge(const CoarseMesh& mesh) {
  double sum = 0.0;
  for (const std::array<int, 3>& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      sum += (mesh.positions[t[k]] - mesh.positions[t[(k + 1) % 3]]).norm();
    }
  }
  return mesh.triangles.empty() ? 0.0 : sum / (3.0 * mesh.triangles.size());
}

// Returns the connected parts of `whole`; vertices without triangles are left out.
std::vector<CoarseMesh> ConnectedParts(const CoarseMesh& whole) {
  std::vector<int> parent(whole.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const std::array<int, 3>& t : whole.triangles) {
    for (int k = 1; k < 3; ++k) {
      const int a = RootOf(t[0], &parent);
      const int b = RootOf(t[k], &parent);
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<int> part_of_root(whole.size(), -1);
  std::vector<int> vertex_in_part(whole.size(), -1);
  std::vector<CoarseMesh> parts;
  for (const std::array<int, 3>& t : whole.triangles) {
    int& part = part_of_root[RootOf(t[0], &parent)];
    if (part < 0) {
      part = static_cast<int>(parts.size());
      parts.emplace_back();
      parts.back().triangle_weight = whole.triangle_weight;
      parts.back().oriented = whole.oriented;
    }
    CoarseMesh& mesh = parts[part];
    std::array<int, 3> corners;
    for (int k = 0; k < 3; ++k) {
      int& vertex = vertex_in_part[t[k]];
      if (vertex < 0) {
        vertex = mesh.size();
        mesh.points.push_back(whole.points[t[k]]);
        mesh.positions.push_back(whole.positions[t[k]]);
      }
      corners[k] = vertex;
    }
    mesh.triangles.push_back(corners);
    mesh.area += whole.triangle_weight * AreaVector(whole.positions, t).norm();
  }
  return parts;
}

}  // namespace

std::vector<CoarseMesh> BuildCoarseMeshes(const Surface& surface,
                                          int vertices,
                                          const std::function<bool()>& should_stop) {
  const PointCloud& cloud = surface.cloud();
  const bool has_triangles = cloud.HasTriangles();
  CoarseMesh whole;
  double spacing = 0.0;
  if (!has_triangles) {
    // The gaps between points that are chosen among few are uneven.
    vertices = std::min(2 * vertices, static_cast<int>(cloud.size()) / 3);
  }
  whole.points = SpreadPoints(surface, vertices, has_triangles, &spacing);
  if (should_stop && should_stop()) return {};
  for (const int point : whole.points) whole.positions.push_back(cloud.points[point]);
  if (has_triangles) {
    whole.triangles = CellTriangles(surface, whole.points, should_stop);
  } else {
    std::vector<Eigen::Vector3d> normals;
    for (const int point : whole.points) normals.push_back(cloud.normals[point]);
    whole.oriented = cloud.normals_oriented;
    whole.triangle_weight = kPointTriangleWeight;
    whole.triangles = TangentTriangles(whole.positions, normals, whole.oriented, spacing);
  }
  if (should_stop && should_stop()) return {};
  std::vector<CoarseMesh> parts = ConnectedParts(whole);
  double area = 0.0;
  for (CoarseMesh& part : parts) {
    part.spacing = MeanEdge(part);
    int on_border = 0;
    for (const int point : part.points) on_border += surface.topology().is_border[point] != 0;
    part.border_share = static_cast<double>(on_border) / part.size();
    area += part.area;
  }
  const auto is_small = [&](const CoarseMesh& part) {
    return part.area < kLeastArea * area || part.size() < kMinVertices || !(part.area > 0.0);
  };
  parts.erase(std::remove_if(parts.begin(), parts.end(), is_small), parts.end());
  std::stable_sort(parts.begin(), parts.end(), [](const CoarseMesh& a, const CoarseMesh& b) {
    return a.area > b.area;
  });
  return parts;
}

std::vector<Eigen::Vector3d> CoarseNormals(const CoarseMesh& mesh) {
  std::vector<Eigen::Vector3d> normals(mesh.size(), Eigen::Vector3d::Zero());
  for (const std::array<int, 3>& t : mesh.triangles) {
    const Eigen::Vector3d area = AreaVector(mesh.positions, t);
    for (const int corner : t) normals[corner] += area;
  }
  for (Eigen::Vector3d& normal : normals) {
    const double norm = normal.norm();
    if (norm > 0.0) normal /= norm;
  }
  return normals;
}

}  // namespace ceres_ed
