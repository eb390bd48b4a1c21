// tracks.csv: the positions, in each frame, of the points that a user has chosen.
#ifndef CERES_ED_IO_RESULTS_TRACKS_CSV_H_
#define CERES_ED_IO_RESULTS_TRACKS_CSV_H_

#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The following two functions return the first line of tracks.csv and a row of it, with line ends.
// `in_camera` is in the camera frame of the frame, in metres.
std::string TracksHeader();
std::string TracksRow(int frame, int id, const Eigen::Vector3d& in_camera, bool visible);

// A row: a point in the camera frame of a frame, in metres.
struct TrackPlace {
  int frame = 0;
  int id = 0;
  Eigen::Vector3d in_camera = Eigen::Vector3d::Zero();
  bool visible = false;
};

// Reads the rows in the order of the file. Errors name file, line, value and what was expected.
StatusOr<std::vector<TrackPlace>> ReadTracks(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_RESULTS_TRACKS_CSV_H_
