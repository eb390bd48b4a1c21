#include "ceres_ed/geometry/orientation.h"

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/normals.h>
#include <ceres_ed/geometry/triangle_area.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

// A mesh with a larger share of border edges is not closed.
constexpr double kMaxBorderShare = 0.02;
// The smallest volume relative to area^1.5 that tells the sides apart; a ball has 0.094.
constexpr double kLeastVolume = 1e-3;
// The number of points whose neighbours are compared, and the number of these neighbours.
constexpr int kComparedPoints = 3000;
constexpr int kComparedNeighbors = 8;
// Neighbours count if they leave the tangent plane by less than this slope, and if their normals
// agree up to sign with at least this cosine.
constexpr double kMaxSlope = 0.3;
constexpr double kMinCosine = 0.7;

// The triangles at an edge, from its lower to its higher point. `forward` counts those that are
// traversed in this direction.
struct EdgeUse {
  std::array<int, 2> triangles = {-1, -1};
  int count = 0;
  int forward = 0;
  int opposite = -1;
  bool is_double = false;

  bool JoinsTwo() const { return count == 2 && !is_double; }
  bool Disagrees() const { return JoinsTwo() && forward != 1; }
};

// The triangles of a mesh with the edges that they share.
class Winding {
 public:
  Winding(const SurfaceTopology& topology, const PointCloud& cloud)
      : topology_(topology), cloud_(cloud), uses_(topology.edges.size()) {
    for (int t = 0; t < static_cast<int>(cloud.triangles.size()); ++t) {
      ForEdges(t, [&](EdgeUse* use, bool is_forward, int opposite) {
        if (use->count < 2) use->triangles[use->count] = t;
        use->is_double |= use->count > 0 && use->opposite == opposite;
        use->opposite = opposite;
        ++use->count;
        if (is_forward) ++use->forward;
      });
    }
  }

  bool IsConsistent() const {
    return std::none_of(
        uses_.begin(), uses_.end(), [](const EdgeUse& use) { return use.Disagrees(); });
  }

  // Returns 1 for each triangle that should be reversed.
  std::vector<char> FindReversed() {
    std::vector<char> is_reversed(cloud_.triangles.size(), 0);
    std::vector<char> is_seen(cloud_.triangles.size(), 0);
    for (int start = 0; start < static_cast<int>(is_seen.size()); ++start) {
      if (is_seen[start] == 0) TurnPart(start, &is_seen, &is_reversed);
    }
    return is_reversed;
  }

 private:
  // Calls visit(use, is_forward, opposite) for each edge of a triangle with three positions.
  template <typename Visitor>
  void ForEdges(int t, const Visitor& visit) {
    std::array<int, 3> corners = cloud_.triangles[t];
    for (int& corner : corners) corner = topology_.representative[corner];
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return;
    for (int i = 0; i < 3; ++i) {
      const int from = corners[i];
      const int to = corners[(i + 1) % 3];
      for (const SurfaceLink& link : topology_.Edges(std::min(from, to))) {
        if (link.to != std::max(from, to)) continue;
        visit(&uses_[&link - topology_.edges.data()], from < to, corners[(i + 2) % 3]);
        break;
      }
    }
  }

  // Makes the part of `start` consistent by reversing the smaller share of its area.
  void TurnPart(int start, std::vector<char>* is_seen, std::vector<char>* is_reversed) {
    std::vector<int> part = {start};
    (*is_seen)[start] = 1;
    double kept_area = 0.0;
    double reversed_area = 0.0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const int t = part[i];
      ((*is_reversed)[t] != 0 ? reversed_area : kept_area) +=
          AreaVector(cloud_.points, cloud_.triangles[t]).norm();
      ForEdges(t, [&](const EdgeUse* use, bool, int) {
        if (!use->JoinsTwo()) return;
        const int other = use->triangles[use->triangles[0] == t ? 1 : 0];
        if ((*is_seen)[other] != 0) return;
        (*is_seen)[other] = 1;
        (*is_reversed)[other] = static_cast<char>((*is_reversed)[t] ^ (use->Disagrees() ? 1 : 0));
        part.push_back(other);
      });
    }
    if (reversed_area <= kept_area) return;
    for (const int t : part) (*is_reversed)[t] ^= 1;
  }

  const SurfaceTopology& topology_;
  const PointCloud& cloud_;
  // The uses of topology.edges; only those from a lower to a higher point are filled in.
  std::vector<EdgeUse> uses_;
};

}  // namespace

std::vector<int> TrianglesAgainstNeighbors(const PointCloud& cloud,
                                           const SurfaceTopology& topology) {
  std::vector<int> against;
  if (!cloud.HasTriangles()) return against;
  Winding winding(topology, cloud);
  if (winding.IsConsistent()) return against;
  const std::vector<char> is_reversed = winding.FindReversed();
  for (int t = 0; t < static_cast<int>(is_reversed.size()); ++t) {
    if (is_reversed[t] != 0) against.push_back(t);
  }
  return against;
}

double ShareOfNormalsAgainstTriangles(const PointCloud& cloud) {
  if (!cloud.HasTriangles() || !cloud.HasNormals()) return 0.0;
  const std::vector<Eigen::Vector3d> outer = ComputeVertexNormals(cloud);
  int known = 0;
  int against = 0;
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    const double cosine = outer[p].dot(cloud.normals[p]);
    if (cosine == 0.0) continue;
    ++known;
    if (cosine < 0.0) ++against;
  }
  return known > 0 ? static_cast<double>(against) / known : 0.0;
}

double ShareOfContradictingNormals(const PointCloud& cloud) {
  if (!cloud.HasNormals()) return 0.0;
  const KdTree tree(cloud.points);
  const int count = static_cast<int>(cloud.size());
  const int stride = std::max(1, count / kComparedPoints);
  std::vector<Neighbor> neighbors;
  int known = 0;
  int against = 0;
  for (int p = 0; p < count; p += stride) {
    const Eigen::Vector3d& normal = cloud.normals[p];
    tree.KNearest(cloud.points[p], kComparedNeighbors, &neighbors);
    for (const Neighbor& neighbor : neighbors) {
      const Eigen::Vector3d& other = cloud.normals[neighbor.index];
      const Eigen::Vector3d offset = cloud.points[neighbor.index] - cloud.points[p];
      const double reach = kMaxSlope * offset.norm();
      const double cosine = normal.dot(other);
      const bool is_beside = reach > 0.0 && std::abs(offset.dot(normal)) < reach &&
                             std::abs(offset.dot(other)) < reach;
      if (!is_beside || std::abs(cosine) < kMinCosine) continue;
      ++known;
      if (cosine < 0.0) ++against;
    }
  }
  return known > 0 ? static_cast<double>(against) / known : 0.0;
}

double EnclosedVolume(const PointCloud& cloud, const SurfaceTopology& topology) {
  if (!topology.HasSurface()) return 0.0;
  const auto borders =
      std::count(topology.edge_is_border.begin(), topology.edge_is_border.end(), char{1});
  if (static_cast<double>(borders) > kMaxBorderShare * static_cast<double>(topology.edges.size())) {
    return 0.0;
  }
  const Eigen::Vector3d origin = cloud.points.front();
  double volume = 0.0;
  double area = 0.0;
  for (const std::array<int, 3>& t : cloud.triangles) {
    const Eigen::Vector3d vector = AreaVector(cloud.points, t);
    volume += vector.dot(cloud.points[t[0]] - origin) / 3.0;
    area += vector.norm();
  }
  return std::abs(volume) > kLeastVolume * std::pow(area, 1.5) ? volume : 0.0;
}

void ReverseOrientation(PointCloud* cloud) {
  for (std::array<int, 3>& t : cloud->triangles) std::swap(t[1], t[2]);
  for (Eigen::Vector3d& normal : cloud->normals) normal = -normal;
}

}  // namespace ceres_ed
