// trajectory.txt: the camera pose in each frame, in the format of the TUM benchmark.
#ifndef CERES_ED_IO_RESULTS_TRAJECTORY_TXT_H_
#define CERES_ED_IO_RESULTS_TRAJECTORY_TXT_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/util/status.h>

#include <map>
#include <string>
#include <vector>

namespace ceres_ed {

// The following two functions return the first line of trajectory.txt and a row of it, with line
// ends. `map_from_camera` is in metres, `time_s` in seconds.
std::string TrajectoryHeader();
std::string TrajectoryRow(double time_s, const CameraPose& map_from_camera);

// Reads map_from_camera by frame. `frame_at` gives the frame of each time of the sequence. Times
// are compared exactly, since rows contain all digits. If a time is none of them, the result is
// empty and a sentence is added to `warnings`. Errors are as those of ReadTrajectory().
StatusOr<std::map<int, CameraPose>> ReadTrajectoryByFrame(const std::string& path,
                                                          const std::map<double, int>& frame_at,
                                                          std::vector<std::string>* warnings);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_RESULTS_TRAJECTORY_TXT_H_
