// A cloud with everything that matching needs, built once.
#ifndef CERES_ED_GEOMETRY_SURFACE_H_
#define CERES_ED_GEOMETRY_SURFACE_H_

#include <ceres_ed/geometry/closest_point.h>
#include <ceres_ed/geometry/intensity.h>
#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/topology.h>

#include <mutex>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A mesh or bare points with normals, topology, search index and sample areas. Neither copied nor
// moved: the index refers to the cloud.
class Surface {
 public:
  // Normals are computed where the cloud has none. `cloud` isn't empty.
  explicit Surface(PointCloud cloud, int num_threads = 1);
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  const PointCloud& cloud() const { return cloud_; }
  const SurfaceTopology& topology() const { return topology_; }
  // The closest point of the surface, between its points too. Built when it is first asked for.
  const SurfaceIndex& index() const;
  // The closest of its points: several times faster. Built when it is first asked for.
  const KdTree& tree() const;
  // The area that each point stands for, relative to the mean of all points: a third of its
  // triangles. 1 for bare points; kept in [0.1, 10].
  const std::vector<double>& relative_areas() const { return relative_areas_; }
  // The radius of the disc that has the area of a point's share: how far from it its nearest
  // neighbours begin. 0 for bare points.
  double radius(int point) const { return radii_[point]; }
  // The unit normal at a hit: corner normals blended, zero where none is known.
  Eigen::Vector3d NormalAt(const SurfaceHit& hit) const;
  // The brightness at a hit: linear on a triangle. Unknown where the cloud has none, or no
  // gradient.
  Intensity IntensityAt(const SurfaceHit& hit) const;
  // The brightness of a point, with the gradient around it. What that takes is built when it is
  // first asked for.
  Intensity IntensityOf(int point) const;

 private:
  PointCloud cloud_;
  SurfaceTopology topology_;
  mutable std::once_flag index_built_;
  mutable std::once_flag tree_built_;
  mutable std::once_flag gradients_built_;
  mutable std::optional<SurfaceIndex> index_;
  mutable std::optional<KdTree> tree_;
  mutable std::vector<Eigen::Vector3d> intensity_gradients_;
  std::vector<double> relative_areas_;
  std::vector<double> radii_;
};

// About `count` of the surface's points, evenly over the order in space; all when there are fewer.
// Isolated vertices of a mesh are left out.
std::vector<int> SamplePoints(const Surface& surface, int count);

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_SURFACE_H_
