// Fewer points and triangles of a surface, for looking at it.
#ifndef CERES_ED_REPORT_VIEW_DECIMATION_H_
#define CERES_ED_REPORT_VIEW_DECIMATION_H_

#include <array>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

struct Decimation {
  // The points that are kept, as indices, ascending. They stay where they are, so that every figure
  // of them stays true.
  std::vector<int> kept;
  // Triangles of indices into `kept`.
  std::vector<std::array<int, 3>> triangles;
};

// Clusters points in the cells of a grid and keeps one point of each cell, the one nearest to the
// mean of the cell (Rossignac and Borrel 1993). Triangles whose corners come together are left out.
// The cells are chosen so that about `max_points` > 0 points stay, and never more than 1.1 times as
// many, with the points `must_keep` (indices) in addition. If there are not more than `max_points`,
// all stay. All points must be finite.
Decimation Decimate(const std::vector<Eigen::Vector3d>& points,
                    const std::vector<std::array<int, 3>>& triangles,
                    int max_points,
                    const std::vector<int>& must_keep = {});

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_VIEW_DECIMATION_H_
