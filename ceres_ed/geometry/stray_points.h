// Points of a file that are no part of its surface.
#ifndef CERES_ED_GEOMETRY_STRAY_POINTS_H_
#define CERES_ED_GEOMETRY_STRAY_POINTS_H_

#include <ceres_ed/geometry/point_cloud.h>

#include <vector>

namespace ceres_ed {

// Returns the points at exactly 0 0 0 that were not measured, in ascending order. Depth cameras
// write them for pixels without depth. There must be at least two of them; in a mesh they must be
// in no triangle, or the edges that lead to them must be more than 10 times as long as the others
// (medians). A surface that passes through the origin has short edges there.
std::vector<int> UnmeasuredPoints(const PointCloud& cloud);

// Returns the points that are far from all others, in ascending order: at most 1 % of the points,
// more than 10 times as far from the median of the coordinates as 99 % of the points are.
std::vector<int> FarPoints(const PointCloud& cloud);

// Removes `points`, in ascending order, and all triangles that use them. The other points keep
// their order. Returns the number of removed triangles.
int RemovePoints(const std::vector<int>& points, PointCloud* cloud);

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_STRAY_POINTS_H_
