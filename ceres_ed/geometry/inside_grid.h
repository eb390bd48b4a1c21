// Which cells of a regular grid lie inside a closed surface.
#ifndef CERES_ED_GEOMETRY_INSIDE_GRID_H_
#define CERES_ED_GEOMETRY_INSIDE_GRID_H_

#include <ceres_ed/geometry/point_cloud.h>

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A grid of cubic cells around a surface, each of which is inside the surface or not. A cell is
// inside if the surface winds around its centre: along a straight line from outside, it is not
// entered as often as it is left. The lines along x, y and z vote, so that a small hole in the
// surface does no harm.
class InsideGrid {
 public:
  // Builds the grid of `cloud`, whose triangles are wound consistently. The edge of a cell is
  // `cell` > 0, in the unit of the points; it is made larger if there were more than 2^24 cells.
  // The time is in proportion to the triangles and the cells.
  InsideGrid(const PointCloud& cloud, double cell);

  // Returns whether the cell around `point` is inside. Points beyond the grid are outside.
  bool IsInside(const Eigen::Vector3d& point) const;

  // Returns whether the straight line from `a` to `b` runs inside, apart from one cell's length
  // near its ends, which may lie on the surface. A line of less than two cells is inside.
  bool IsSegmentInside(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

  // The edge of a cell, in the unit of the points.
  double cell() const { return cell_; }
  // Returns the volume of all cells that are inside, in cubed units of the points.
  double Volume() const;
  // Return the lower corner of the grid and the lengths of its sides, in the unit of the points.
  const Eigen::Vector3d& origin() const { return origin_; }
  Eigen::Vector3d Extent() const { return cell_ * Eigen::Vector3d(size_[0], size_[1], size_[2]); }

 private:
  std::size_t Index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * size_[1] + y) * size_[0] + x;
  }
  // Returns, for each line along `axis` (u, v: the next two axes), how often the surface is entered
  // (+1) or left (-1) just before each cell.
  std::vector<signed char> Crossings(const PointCloud& cloud, int axis) const;
  // Adds the votes of the lines along `axis`.
  void Vote(const PointCloud& cloud, int axis);

  double cell_;
  Eigen::Vector3d origin_;
  std::array<int, 3> size_;
  // For each cell the number of axes along which it is inside.
  std::vector<unsigned char> votes_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_INSIDE_GRID_H_
