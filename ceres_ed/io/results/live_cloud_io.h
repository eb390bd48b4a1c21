// The map as a camera has it in one frame: written in every frame, so written fast.
#ifndef CERES_ED_IO_RESULTS_LIVE_CLOUD_IO_H_
#define CERES_ED_IO_RESULTS_LIVE_CLOUD_IO_H_

#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A point of the map, camera frame.
struct LivePoint {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  int id = -1;
  int birth_frame = -1;
  // In the camera frame of that frame.
  Eigen::Vector3f birth_position = Eigen::Vector3f::Zero();
};

// Returns ok when `path` is a binary PLY of element 'vertex' with float x y z, int id, int
// birth_frame and float bx by bz, written under a temporary name and renamed; else an error with
// the system's reason.
Status WriteLiveCloud(const std::string& path, const std::vector<LivePoint>& points);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_RESULTS_LIVE_CLOUD_IO_H_
