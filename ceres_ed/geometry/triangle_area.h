// Areas of triangles.
#ifndef CERES_ED_GEOMETRY_TRIANGLE_AREA_H_
#define CERES_ED_GEOMETRY_TRIANGLE_AREA_H_

#include <array>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ceres_ed {

// Returns the area vector of a triangle, (b - a) x (c - a) / 2: it is normal to the triangle, seen
// from its tip the corners run counter-clockwise, and its length is the area.
inline Eigen::Vector3d AreaVector(const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b,
                                  const Eigen::Vector3d& c) {
  return 0.5 * (b - a).cross(c - a);
}

// Returns the area vector of a triangle that is given by the indices of its corners.
inline Eigen::Vector3d AreaVector(const std::vector<Eigen::Vector3d>& points,
                                  const std::array<int, 3>& triangle) {
  return AreaVector(points[triangle[0]], points[triangle[1]], points[triangle[2]]);
}

// Returns the area of all triangles together.
inline double SurfaceArea(const std::vector<Eigen::Vector3d>& points,
                          const std::vector<std::array<int, 3>>& triangles) {
  double area = 0.0;
  for (const std::array<int, 3>& triangle : triangles) area += AreaVector(points, triangle).norm();
  return area;
}

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_TRIANGLE_AREA_H_
