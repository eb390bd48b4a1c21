// A surface thinned out and smoothed: what a rigid search looks at.
#ifndef CERES_ED_REGISTRATION_RIGID_COARSE_SURFACE_H_
#define CERES_ED_REGISTRATION_RIGID_COARSE_SURFACE_H_

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/surface.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// One point for each cube of `spacing` that the surface meets (two where it has two sides there):
// the mean of its points, with the normal of the summed area vectors over that cube and those near
// it. Vertex normals of a noisy mesh are noise; area vectors of a patch depend on its border alone,
// so that noise cancels. Neither copied nor moved: the tree refers to the points.
class CoarseSurface {
 public:
  // `spacing` > 0 in the unit of the surface. Before they tell sides apart, the area vectors of a
  // mesh's points are averaged `passes` times with those of their neighbours along edges.
  CoarseSurface(const Surface& surface, double spacing, int passes);
  CoarseSurface(const CoarseSurface&) = delete;
  CoarseSurface& operator=(const CoarseSurface&) = delete;

  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  // Of unit length, or zero where none is known.
  const std::vector<Eigen::Vector3d>& normals() const { return normals_; }
  // 1 where a point of the surface's border went in.
  const std::vector<char>& is_border() const { return is_border_; }
  const KdTree& tree() const { return tree_; }
  int size() const { return static_cast<int>(points_.size()); }

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<char> is_border_;
  KdTree tree_;
};

// The median angle in radians between the normals of points that share an edge: small on a mesh
// that resolves its surface, large where noise is a good part of an edge. 0 for bare points.
double MedianNormalTurn(const Surface& surface);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_RIGID_COARSE_SURFACE_H_
