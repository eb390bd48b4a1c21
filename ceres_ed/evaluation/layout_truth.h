// Truth that belongs to the layouts of data sets: boxes, tracked points, points at start and end.
#ifndef CERES_ED_EVALUATION_LAYOUT_TRUTH_H_
#define CERES_ED_EVALUATION_LAYOUT_TRUTH_H_

#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/io/sequence/picture_tracks.h>
#include <ceres_ed/stereo/depth_source.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The camera of the pictures that SurgT annotates: those that OpenCV rectifies with the principal
// points at the same place and alpha = 0.
struct AnnotatedCamera {
  PinholeCamera camera;
  // In pixels times metres; 0 if the sequence is not a stereo sequence.
  double focal_times_baseline = 0.0;
};
AnnotatedCamera SurgTCamera(const DepthSource& source);

// Returns the pixel of camera `to` that looks along the same ray as `pixel` of camera `from`.
Eigen::Vector2d PixelOfRay(const Eigen::Vector2d& pixel,
                           const PinholeCamera& from,
                           const PinholeCamera& to);

// Returns the tracks in the picture that belong to the layout of a sequence, in pixels of the
// camera of its depth: the middles of the boxes of SurgT (gt_rectified_*.yaml) that are not
// difficult, and the points of SuPer (rgb/left_pts.npy, an array of (frames, points, 2) numbers in
// the order of the frames; a point that is not a number is not visible). There are none in other
// layouts. Errors name the file; what can't be read because it is an object of Python gives a
// sentence in `warnings`.
StatusOr<std::vector<TrackObservation>> ReadLayoutTracks(const std::string& folder,
                                                         const DepthSource& source,
                                                         std::vector<std::string>* warnings);

}  // namespace ceres_ed

#endif  // CERES_ED_EVALUATION_LAYOUT_TRUTH_H_
