// The closest point on a surface.
#ifndef CERES_ED_GEOMETRY_CLOSEST_POINT_H_
#define CERES_ED_GEOMETRY_CLOSEST_POINT_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/topology.h>

#include <limits>
#include <memory>

#include <Eigen/Core>

namespace ceres_ed {

// Returns the barycentric coordinates (sum 1, none negative) of the point of triangle a, b, c that
// is closest to `query`. A coordinate is exactly 0 when that point lies on the opposite edge or at
// a corner. A triangle without area is treated as a segment or a point.
Eigen::Vector3d ClosestPointOnTriangle(const Eigen::Vector3d& query,
                                       const Eigen::Vector3d& a,
                                       const Eigen::Vector3d& b,
                                       const Eigen::Vector3d& c);

// The closest point of a surface, as found by a search.
struct SurfaceHit {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  // The squared distance from the query; infinite when nothing was found.
  double squared_distance = std::numeric_limits<double>::infinity();
  // The index of the triangle in the cloud; -1 on bare points or when nothing was found.
  int triangle = -1;
  // The weights of the three corners of `triangle`; (1, 0, 0) on bare points.
  Eigen::Vector3d barycentric = Eigen::Vector3d::UnitX();
  // The corner of `triangle` that is nearest to `position`, or the bare point; -1 when nothing was
  // found.
  int nearest_vertex = -1;
  // True if the hit lies on a border edge or at a border vertex of a mesh, or is a border point.
  // The query may then belong to a part of the surface that is missing.
  bool on_border = false;

  bool found() const { return nearest_vertex >= 0; }
  // The index of the triangle, or of the bare point. It serves as a hint for the search from a
  // query nearby.
  int place() const { return triangle >= 0 ? triangle : nearest_vertex; }
};

// A search tree over the triangles of a mesh, or over the points of a cloud without triangles. The
// index refers to `cloud`, which must outlive it and must not change. Every search is exact and
// breaks ties by the lowest index. Any number of threads may search at the same time. Vertices of a
// mesh that are in no triangle do not belong to its surface.
class SurfaceIndex {
 public:
  // `topology` is the topology of `cloud`. It says which edges are borders and is used only here.
  SurfaceIndex(const PointCloud& cloud, const SurfaceTopology& topology);
  // Does the same, and builds the topology itself.
  explicit SurfaceIndex(const PointCloud& cloud);
  ~SurfaceIndex();
  SurfaceIndex(SurfaceIndex&&) noexcept;
  SurfaceIndex& operator=(SurfaceIndex&&) noexcept;

  // Returns the closest point that is at most `max_distance` away. The result is not found() when
  // there is none or when `query` is not finite. `hint` is the place() of an earlier hit that is
  // expected to be near, or -1. A near hint makes the search faster; the result does not depend on
  // it.
  SurfaceHit Closest(const Eigen::Vector3d& query,
                     double max_distance = std::numeric_limits<double>::infinity(),
                     int hint = -1) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_CLOSEST_POINT_H_
