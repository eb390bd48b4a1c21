// A thinned out and smoothed surface, on which the rigid search works.
#ifndef CERES_ED_REGISTRATION_RIGID_COARSE_SURFACE_H_
#define CERES_ED_REGISTRATION_RIGID_COARSE_SURFACE_H_

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/surface.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// One point for each cube of edge `spacing` that the surface meets (two if the surface has two
// sides there). The point is the mean of the surface's points in the cube; its normal is that of
// the sum of the area vectors in this cube and in those near it. On a noisy mesh vertex normals
// contain mostly noise, whereas the area vector of a patch depends only on its border, so that
// noise cancels. Objects cannot be copied or moved, because the tree refers to the points.
class CoarseSurface {
 public:
  // `spacing` > 0 is in the unit of the surface. Before they are used to distinguish sides, the
  // area vectors of a mesh's points are averaged `passes` times with those of their neighbours
  // along edges.
  CoarseSurface(const Surface& surface, double spacing, int passes);
  CoarseSurface(const CoarseSurface&) = delete;
  CoarseSurface& operator=(const CoarseSurface&) = delete;

  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  // Returns the normals, of unit length, or zero where none is known.
  const std::vector<Eigen::Vector3d>& normals() const { return normals_; }
  // Returns 1 for each point that contains a point of the surface's border, else 0.
  const std::vector<char>& is_border() const { return is_border_; }
  const KdTree& tree() const { return tree_; }
  int size() const { return static_cast<int>(points_.size()); }

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<char> is_border_;
  KdTree tree_;
};

// Returns the median angle in radians between the normals of points that share an edge. It is small
// on a mesh that resolves its surface, and large if the noise is a considerable part of an edge. It
// is 0 for bare points.
double MedianNormalTurn(const Surface& surface);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_RIGID_COARSE_SURFACE_H_
