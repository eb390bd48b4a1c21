// How far a corner is to be trusted.
#ifndef CERES_ED_SLAM_FRAME_CORNER_WEIGHTS_H_
#define CERES_ED_SLAM_FRAME_CORNER_WEIGHTS_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/slam/frame/camera_tracker.h>

#include <vector>

namespace ceres_ed {

// Returns for each corner, in [0, 1], how well its motion agrees with that of its neighbours. The
// motion that the map does not predict yet is that of the camera and of the tissue, and both are
// smooth: the motion of a corner that is right differs little from the median of its neighbours. So
// a part of the tissue that moves on its own is followed as a whole, however far it moves, and a
// corner that was confused with another one is not.
std::vector<double> WeighCorners(const std::vector<PointMatch>& matches,
                                 const CameraPose& camera_from_map);

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_CORNER_WEIGHTS_H_
