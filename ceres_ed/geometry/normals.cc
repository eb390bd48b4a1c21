#include "ceres_ed/geometry/normals.h"

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/topology.h>
#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

// Neighbours span a plane when their second largest variance is at least this fraction of the
// largest one. Below it they lie on a line.
constexpr double kMinPlanarity = 1e-6;

struct NeighborEdge {
  // The cost 1 - |n_a . n_b|.
  double cost;
  int a;
  int b;

  bool operator<(const NeighborEdge& other) const {
    if (cost != other.cost) return cost < other.cost;
    return a != other.a ? a < other.a : b < other.b;
  }
};

// Disjoint sets of indices (union-find).
class DisjointSets {
 public:
  explicit DisjointSets(int size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }
  int Find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  // Joins the sets of a and b. Returns false if they are in the same set already.
  bool Join(int a, int b) {
    a = Find(a);
    b = Find(b);
    if (a == b) return false;
    parent_[std::max(a, b)] = std::min(a, b);
    return true;
  }

 private:
  std::vector<int> parent_;
};

// Returns the direction of least spread of the neighbours, or zero if they do not span a plane.
Eigen::Vector3d PlaneNormal(const std::vector<Eigen::Vector3d>& points,
                            const Neighbor* neighbors,
                            int count) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int i = 0; i < count; ++i) mean += points[neighbors[i].index] / count;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d offset = points[neighbors[i].index] - mean;
    covariance += offset * offset.transpose();
  }
  const double trace = covariance.trace();
  if (count < 3 || !(trace > 0.0)) return Eigen::Vector3d::Zero();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance / trace);
  if (eigen.eigenvalues()[1] < kMinPlanarity * eigen.eigenvalues()[2]) {
    return Eigen::Vector3d::Zero();
  }
  return eigen.eigenvectors().col(0);
}

// The nearest points of every point, itself included.
struct Neighborhoods {
  Neighborhoods(const std::vector<Eigen::Vector3d>& points, int size, int num_threads)
      : size(size), nearest(points.size() * size), counts(points.size(), 0) {
    const KdTree tree(points);
    ParallelFor(num_threads, static_cast<int>(points.size()), [&](int begin, int end) {
      for (int p = begin; p < end; ++p) {
        counts[p] =
            tree.KNearest(points[p], size, &nearest[static_cast<std::size_t>(p) * this->size]);
      }
    });
  }

  const Neighbor* Of(int point) const { return &nearest[static_cast<std::size_t>(point) * size]; }

  int size;
  // `size` entries for each point, of which the first counts[point] are filled in.
  std::vector<Neighbor> nearest;
  std::vector<int> counts;
};

// Returns the minimum spanning forest of the neighbour graph: for each point, the points to which
// it is linked.
std::vector<std::vector<int>> SpanningForest(const std::vector<Eigen::Vector3d>& normals,
                                             const Neighborhoods& around) {
  const int num_points = static_cast<int>(normals.size());
  std::vector<NeighborEdge> edges;
  edges.reserve(around.nearest.size());
  for (int a = 0; a < num_points; ++a) {
    for (int i = 0; i < around.counts[a]; ++i) {
      const int b = around.Of(a)[i].index;
      if (a == b) continue;
      edges.push_back({1.0 - std::abs(normals[a].dot(normals[b])), std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(edges.begin(), edges.end());
  DisjointSets sets(num_points);
  std::vector<std::vector<int>> links(num_points);
  for (const NeighborEdge& edge : edges) {
    if (!sets.Join(edge.a, edge.b)) continue;
    links[edge.a].push_back(edge.b);
    links[edge.b].push_back(edge.a);
  }
  return links;
}

// Makes the signs of the normals agree in each tree of the forest, and points them outward. Returns
// the size of the largest tree.
int OrientNormals(const std::vector<Eigen::Vector3d>& points,
                  const std::vector<std::vector<int>>& forest,
                  std::vector<Eigen::Vector3d>* normals) {
  const int num_points = static_cast<int>(points.size());
  std::vector<char> visited(num_points, 0);
  std::size_t largest = 0;
  for (int start = 0; start < num_points; ++start) {
    if (visited[start]) continue;
    // Walk through a tree of the forest, and turn each normal to the side of the one before it.
    std::vector<int> part = {start};
    visited[start] = 1;
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < part.size(); ++i) {
      const int p = part[i];
      centroid += points[p];
      for (const int q : forest[p]) {
        if (visited[q]) continue;
        visited[q] = 1;
        if ((*normals)[p].dot((*normals)[q]) < 0.0) (*normals)[q] = -(*normals)[q];
        part.push_back(q);
      }
    }
    largest = std::max(largest, part.size());
    centroid /= static_cast<double>(part.size());
    double outward = 0.0;
    for (const int p : part) outward += (points[p] - centroid).dot((*normals)[p]);
    if (outward >= 0.0) continue;
    for (const int p : part) (*normals)[p] = -(*normals)[p];
  }
  return static_cast<int>(largest);
}

// Adds to `sum` the normal of a triangle, weighted by the angle of its corner `i`; nothing if the
// triangle has no area.
void AddCornerNormal(const PointCloud& cloud,
                     const std::array<int, 3>& triangle,
                     int i,
                     Eigen::Vector3d* sum) {
  const Eigen::Vector3d& a = cloud.points[triangle[i]];
  const Eigen::Vector3d ab = cloud.points[triangle[(i + 1) % 3]] - a;
  const Eigen::Vector3d ac = cloud.points[triangle[(i + 2) % 3]] - a;
  const Eigen::Vector3d cross = ab.cross(ac);
  const double norm = cross.norm();
  if (!(norm > 0.0)) return;
  const double angle = std::atan2(norm, ab.dot(ac));
  *sum += angle / norm * cross;
}

}  // namespace

std::vector<Eigen::Vector3d> ComputeVertexNormals(const PointCloud& cloud) {
  const std::vector<int> representative = WeldPoints(cloud.points);
  std::vector<Eigen::Vector3d> normals(cloud.size(), Eigen::Vector3d::Zero());
  for (const std::array<int, 3>& triangle : cloud.triangles) {
    for (int i = 0; i < 3; ++i) {
      AddCornerNormal(cloud, triangle, i, &normals[representative[triangle[i]]]);
    }
  }
  for (std::size_t p = 0; p < normals.size(); ++p) {
    if (representative[p] != static_cast<int>(p)) {
      // The representative has a lower index, so its normal is computed already.
      normals[p] = normals[representative[p]];
      continue;
    }
    const double norm = normals[p].norm();
    if (norm > 0.0) normals[p] /= norm;
  }
  return normals;
}

std::vector<Eigen::Vector3d> ComputeVertexNormalsAt(const std::vector<int>& points,
                                                    const PointCloud& cloud,
                                                    const SurfaceTopology& topology) {
  // The rank in `points` of each representative, or -1.
  std::vector<int> rank(cloud.size(), -1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    rank[topology.representative[points[i]]] = static_cast<int>(i);
  }
  std::vector<Eigen::Vector3d> normals(points.size(), Eigen::Vector3d::Zero());
  for (const std::array<int, 3>& triangle : cloud.triangles) {
    for (int i = 0; i < 3; ++i) {
      const int at = rank[topology.representative[triangle[i]]];
      if (at >= 0) AddCornerNormal(cloud, triangle, i, &normals[at]);
    }
  }
  for (Eigen::Vector3d& normal : normals) {
    const double norm = normal.norm();
    if (norm > 0.0) normal /= norm;
  }
  // Points at one position share a normal.
  for (std::size_t i = 0; i < points.size(); ++i) {
    normals[i] = normals[rank[topology.representative[points[i]]]];
  }
  return normals;
}

std::vector<Eigen::Vector3d> EstimateNormals(const std::vector<Eigen::Vector3d>& points,
                                             int neighbors,
                                             int num_threads,
                                             int* largest_part) {
  CHECK_GE(neighbors, 3);
  // Fit a plane to the neighbours of each point.
  const Neighborhoods around(points, neighbors, num_threads);
  std::vector<Eigen::Vector3d> normals(points.size(), Eigen::Vector3d::Zero());
  ParallelFor(num_threads, static_cast<int>(points.size()), [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      normals[p] = PlaneNormal(points, around.Of(p), around.counts[p]);
    }
  });
  const int largest = OrientNormals(points, SpanningForest(normals, around), &normals);
  if (largest_part != nullptr) *largest_part = largest;
  return normals;
}

void ChooseNormalSigns(const std::vector<Eigen::Vector3d>& points,
                       std::vector<Eigen::Vector3d>* normals,
                       int neighbors,
                       int num_threads) {
  CHECK_EQ(points.size(), normals->size());
  const Neighborhoods around(points, neighbors, num_threads);
  OrientNormals(points, SpanningForest(*normals, around), normals);
}

void EnsureNormals(PointCloud* cloud, int num_threads) {
  if (cloud->HasNormals()) return;
  cloud->normals_oriented = cloud->HasTriangles();
  cloud->normals = cloud->HasTriangles()
                       ? ComputeVertexNormals(*cloud)
                       : EstimateNormals(cloud->points, kNormalNeighbors, num_threads);
}

}  // namespace ceres_ed
