// The pose of a camera from points whose counterparts are partly wrong.
#ifndef CERES_ED_SLAM_FRAME_POSE_FROM_MATCHES_H_
#define CERES_ED_SLAM_FRAME_POSE_FROM_MATCHES_H_

#include <ceres_ed/slam/frame/camera_tracker.h>

#include <optional>
#include <vector>

namespace ceres_ed {

// Returns the pose with which most matches agree to within `tolerance` (map units), by random
// samples of three matches (RANSAC, Fischler and Bolles 1981) with a fixed seed, and least squares
// over all that agree. Returns nothing if fewer than `fewest` >= 3 matches agree.
std::optional<CameraPose> PoseFromMatches(const std::vector<PointMatch>& matches,
                                          double tolerance,
                                          int fewest);

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_POSE_FROM_MATCHES_H_
