// The closest point on a surface.
#ifndef CERES_ED_GEOMETRY_CLOSEST_POINT_H_
#define CERES_ED_GEOMETRY_CLOSEST_POINT_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/topology.h>

#include <limits>
#include <memory>

#include <Eigen/Core>

namespace ceres_ed {

// The barycentric coordinates (sum 1, none negative) of the point of triangle a, b, c closest to
// `query`; a coordinate is exactly 0 when that point lies on the opposite edge or at a corner.
// Triangles without area are treated as the segment or point that they are.
Eigen::Vector3d ClosestPointOnTriangle(const Eigen::Vector3d& query,
                                       const Eigen::Vector3d& a,
                                       const Eigen::Vector3d& b,
                                       const Eigen::Vector3d& c);

// Where the closest point lies.
struct SurfaceHit {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  // Infinite when nothing was found.
  double squared_distance = std::numeric_limits<double>::infinity();
  // Index into the cloud's triangles, -1 on bare points or when nothing was found.
  int triangle = -1;
  // Weights of the three corners of `triangle`; (1, 0, 0) on bare points.
  Eigen::Vector3d barycentric = Eigen::Vector3d::UnitX();
  // The corner of `triangle` nearest to `position`, or the bare point; -1 when nothing was found.
  int nearest_vertex = -1;
  // The hit lies on a border edge or at a border vertex of a mesh: the query may belong to a part
  // of the surface that is missing.
  bool on_border = false;

  bool found() const { return nearest_vertex >= 0; }
  // The triangle, or the bare point: a hint for the search of something near.
  int place() const { return triangle >= 0 ? triangle : nearest_vertex; }
};

// A search tree over the triangles of a mesh, or over the points of a bare cloud. `cloud` is kept
// by reference: it must outlive the index and stay as it is. Every search is exact, breaks ties by
// the lowest index, and may run on any number of threads at once. Vertices in no triangle of a mesh
// are no part of its surface.
class SurfaceIndex {
 public:
  // `topology` is that of `cloud` (used here only); it tells the borders.
  SurfaceIndex(const PointCloud& cloud, const SurfaceTopology& topology);
  // The same, and builds the topology itself.
  explicit SurfaceIndex(const PointCloud& cloud);
  ~SurfaceIndex();
  SurfaceIndex(SurfaceIndex&&) noexcept;
  SurfaceIndex& operator=(SurfaceIndex&&) noexcept;

  // The closest point that is at most `max_distance` away; not found() when there is none or when
  // `query` is not finite. `hint` is the place() of an earlier hit that is thought to be near, or
  // -1: the nearer it is the faster is the search, and what is found doesn't depend on it.
  SurfaceHit Closest(const Eigen::Vector3d& query,
                     double max_distance = std::numeric_limits<double>::infinity(),
                     int hint = -1) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_CLOSEST_POINT_H_
