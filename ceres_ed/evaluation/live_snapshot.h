// The map of a finished run at one of its frames.
#ifndef CERES_ED_EVALUATION_LIVE_SNAPSHOT_H_
#define CERES_ED_EVALUATION_LIVE_SNAPSHOT_H_

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Every map point as it is in `frame`, and where it came from; the vectors are of one length.
struct LiveSnapshot {
  int frame = 0;
  // Camera frame of `frame`, metres.
  std::vector<Eigen::Vector3d> points;
  // The name of each point, the same in every frame and never given to another.
  std::vector<int> ids;
  // The frame that each point was first seen in, and where it was in the camera frame of that one.
  std::vector<int> birth_frames;
  std::vector<Eigen::Vector3d> birth_points;

  std::size_t size() const { return points.size(); }
};

}  // namespace ceres_ed

#endif  // CERES_ED_EVALUATION_LIVE_SNAPSHOT_H_
