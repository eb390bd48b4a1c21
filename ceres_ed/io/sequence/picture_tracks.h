// tracks_2d.csv: points that were followed in the pictures of a sequence, as truth for a tracker.
#ifndef CERES_ED_IO_SEQUENCE_PICTURE_TRACKS_H_
#define CERES_ED_IO_SEQUENCE_PICTURE_TRACKS_H_

#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Where a track is in a frame, pixels; integers are pixel centres.
struct TrackObservation {
  int frame = 0;
  int track = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

// Returns the rows `frame,track,u,v` (pixels) of a file of picture tracks; text behind # and a
// header are ignored. Errors name file, line, value and what was expected.
StatusOr<std::vector<TrackObservation>> ReadPictureTracks(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_PICTURE_TRACKS_H_
