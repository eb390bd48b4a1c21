// tracks.csv: the positions, in each frame, of the points that a user has chosen.
#ifndef CERES_ED_IO_RESULTS_TRACKS_CSV_H_
#define CERES_ED_IO_RESULTS_TRACKS_CSV_H_

#include <string>

#include <Eigen/Core>

namespace ceres_ed {

// The following two functions return the first line of tracks.csv and a row of it, with line ends.
// `in_camera` is in the camera frame of the frame, in metres.
std::string TracksHeader();
std::string TracksRow(int frame, int id, const Eigen::Vector3d& in_camera, bool visible);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_RESULTS_TRACKS_CSV_H_
