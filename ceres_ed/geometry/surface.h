// A point cloud together with everything that matching needs, built once.
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

// A mesh, or points without triangles, with normals, topology, search index and sample areas. It
// can't be copied or moved, since the index refers to the cloud.
class Surface {
 public:
  // Computes normals if the cloud has none. `cloud` must not be empty, and its triangles must name
  // its points.
  explicit Surface(PointCloud cloud, int num_threads = 1);
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  const PointCloud& cloud() const { return cloud_; }
  // For bare points, is_border has the points of FindBorderPoints(). It is built at the first call.
  const SurfaceTopology& topology() const;
  // The index for the closest point of the surface, which may lie between its points. It is built
  // at the first call.
  const SurfaceIndex& index() const;
  // The index for the closest of its points, which is several times faster. It is built at the
  // first call.
  const KdTree& tree() const;
  // The area that each point represents, relative to the mean of all points: a third of the area of
  // its triangles, limited to [0.1, 10]. It is 1 for points without triangles.
  const std::vector<double>& relative_areas() const { return relative_areas_; }
  // The radius of the disc whose area is that of a point's share, in the unit of the points. The
  // nearest neighbours of the point begin at about that distance. It is 0 for points without
  // triangles.
  double radius(int point) const { return radii_[point]; }
  // Returns the unit normal at a hit: the blended normals of the corners. It is zero where no
  // normal is known.
  Eigen::Vector3d NormalAt(const SurfaceHit& hit) const;
  // Returns the brightness at a hit, which is linear on each triangle. It is unknown if the cloud
  // has no brightness, or if the gradient is not determined.
  Intensity IntensityAt(const SurfaceHit& hit) const;
  // Returns the brightness of a point and the gradient around it. The gradients are computed at the
  // first call.
  Intensity IntensityOf(int point) const;

 private:
  PointCloud cloud_;
  int num_threads_;
  mutable std::once_flag topology_built_;
  mutable std::once_flag index_built_;
  mutable std::once_flag tree_built_;
  mutable std::once_flag gradients_built_;
  mutable SurfaceTopology topology_;
  mutable std::optional<SurfaceIndex> index_;
  mutable std::optional<KdTree> tree_;
  mutable std::vector<Eigen::Vector3d> intensity_gradients_;
  std::vector<double> relative_areas_;
  std::vector<double> radii_;
};

// Returns about `count` of the surface's points, spread evenly over its walk order, or all if there
// are fewer. Isolated vertices of a mesh are not among them.
std::vector<int> SamplePoints(const Surface& surface, int count);

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_SURFACE_H_
