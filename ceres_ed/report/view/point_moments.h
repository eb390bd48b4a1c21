// The places of points in the moments of a sequence.
#ifndef CERES_ED_REPORT_VIEW_POINT_MOMENTS_H_
#define CERES_ED_REPORT_VIEW_POINT_MOMENTS_H_

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Moments are those frames of a sequence that are shown. Each point is there from one of them to
// another.
struct PointMoments {
  // The number of moments, at least 1.
  int count = 1;
  // Point i at moment m is at places[m * first.size() + i]. Empty: the points stand still. Before
  // its first moment a point has the place of that one, and after its last one of this.
  std::vector<Eigen::Vector3d> places;
  // The first and the last moment in which each point is there.
  std::vector<int> first;
  std::vector<int> last;

  // Returns the moment at `at` of the way, where 0 is the first moment and 1 the last one.
  int MomentAt(double at) const;
  // Returns `at` of a moment.
  double AtOf(int moment) const;
  bool IsThere(int point, int moment) const {
    return first[point] <= moment && moment <= last[point];
  }
  const Eigen::Vector3d& Place(int point, int moment) const {
    return places[static_cast<std::size_t>(moment) * first.size() +
                  static_cast<std::size_t>(point)];
  }
};

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_VIEW_POINT_MOMENTS_H_
