// Which points of a fitted surface its target shows.
#ifndef CERES_ED_REPORT_VIEW_SEEN_POINTS_H_
#define CERES_ED_REPORT_VIEW_SEEN_POINTS_H_

#include <ceres_ed/geometry/point_cloud.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns the median distance of a point from its nearest neighbour; 0 for fewer than two points.
double MedianSpacing(const std::vector<Eigen::Vector3d>& points);

// Returns 1 for each point of `result` that lies on a part which `target` does not show, such as
// the side of a body that the camera did not see, and 0 for all others. The target shows the places
// of `result` that are closest to its points, and what is not farther from them than 2.5 times
// the median distance between neighbouring points of the target. Where the target shows nothing at
// all of the result, every point is 0. Both must have points.
std::vector<char> PointsNotShown(const PointCloud& result, const PointCloud& target);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_VIEW_SEEN_POINTS_H_
