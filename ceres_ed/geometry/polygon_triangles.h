// Cuts polygons into triangles.
#ifndef CERES_ED_GEOMETRY_POLYGON_TRIANGLES_H_
#define CERES_ED_GEOMETRY_POLYGON_TRIANGLES_H_

#include <array>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns triangles of the corners of a polygon, which may be bent a little: two fewer than it has
// corners, each turned like the polygon. A convex polygon becomes the fan of its first
// corner. From a concave one ears are cut off, the best shaped one first: corners whose triangle
// lies inside it (Meisters 1975). What has no ear, because its sides cross or coincide, and what
// has more than 256 corners, becomes a fan, too.
std::vector<std::array<int, 3>> PolygonTriangles(const std::vector<Eigen::Vector3d>& corners);

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_POLYGON_TRIANGLES_H_
