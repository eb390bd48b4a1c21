// trajectory.txt: where the camera was in each frame, as the TUM benchmark has it.
#ifndef CERES_ED_IO_RESULTS_TRAJECTORY_TXT_H_
#define CERES_ED_IO_RESULTS_TRAJECTORY_TXT_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/util/status.h>

#include <map>
#include <string>
#include <vector>

namespace ceres_ed {

// Return the first line of trajectory.txt and a row of it, with their line ends. `map_from_camera`
// is in metres, `time_s` in seconds.
std::string TrajectoryHeader();
std::string TrajectoryRow(double time_s, const CameraPose& map_from_camera);

// Returns map_from_camera by frame. `frame_at` has the frame of each time of the sequence; times
// are compared exactly, since rows give all digits. A time that is none of them makes the result
// empty, with a sentence in `warnings`. Errors as of ReadTrajectory.
StatusOr<std::map<int, CameraPose>> ReadTrajectoryByFrame(const std::string& path,
                                                          const std::map<double, int>& frame_at,
                                                          std::vector<std::string>* warnings);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_RESULTS_TRAJECTORY_TXT_H_
