// Decides whether a frame says anything about a deformation of the tissue, or only of the camera.
#ifndef CERES_ED_SLAM_FRAME_STILL_TISSUE_H_
#define CERES_ED_SLAM_FRAME_STILL_TISSUE_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/slam/frame/camera_tracker.h>

#include <vector>

namespace ceres_ed {

// The distance of a point of the map from the plane of its patch, and the node that moves it most.
struct NodeResidual {
  int node = -1;
  double distance = 0.0;
};

// Returns how much more the mean residuals of the nodes are spread than residuals with independent
// errors would have them: the F statistic of an analysis of variance with the nodes as groups,
//   F = (sum_k n_k m_k^2 / K) / (sum_k sum_i (r_ki - m_k)^2 / (N - K)),
// divided by `points_per_window` >= 1, the number of points whose patches share their pixels. It is
// about 1 where nothing but noise is left, and grows with the square of the deformation. The
// variance within the nodes is at least `least_deviation`^2, in the unit of the residuals, > 0.
// Nodes with few points do not count. Returns 0 if there are no others.
double SpreadBetweenNodes(std::vector<NodeResidual> residuals,
                          double points_per_window,
                          double least_deviation);

// How far corners agree with their neighbours about where the tissue has moved.
struct Coherence {
  // In [-1, 1]: about 0 where tissue is still, since errors of single corners are independent, and
  // about 1 where it moves much farther than these errors.
  double value = 0.0;
  // The standard deviation of the value if the errors are independent.
  double deviation = 0.0;
};

// Returns the weighted correlation of the residuals r of all pairs of corners that are at most
// `reach` > 0 map units apart; 0 if there are none:
//   value = sum w_i w_j r_i . r_j / S,  deviation^2 = sum (w_i w_j r_i . r_j)^2 / S^2,
//   S = sum w_i w_j (|r_i|^2 + |r_j|^2) / 2
Coherence CornerCoherence(const std::vector<PointMatch>& matches,
                          const CameraPose& camera_from_map,
                          double reach);

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_STILL_TISSUE_H_
