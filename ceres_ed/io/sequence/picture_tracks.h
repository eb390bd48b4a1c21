// tracks_2d.csv: points that were followed in the images of a sequence, as ground truth for
// tracking.
#ifndef CERES_ED_IO_SEQUENCE_PICTURE_TRACKS_H_
#define CERES_ED_IO_SEQUENCE_PICTURE_TRACKS_H_

#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The position of a track in a frame, in pixels. Integer coordinates are pixel centres.
struct TrackObservation {
  int frame = 0;
  int track = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

// Reads the rows `frame,track,u,v` (pixels) of a file of tracks. Text after # and a header are
// ignored. Errors name file, line, value and what was expected.
StatusOr<std::vector<TrackObservation>> ReadPictureTracks(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_PICTURE_TRACKS_H_
