// What there is to see of the tracking of a sequence.
#ifndef CERES_ED_REPORT_VIEW_SEQUENCE_VIEW_H_
#define CERES_ED_REPORT_VIEW_SEQUENCE_VIEW_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/io/results/frames_csv.h>
#include <ceres_ed/io/results/live_cloud_io.h>
#include <ceres_ed/io/results/map_ply.h>
#include <ceres_ed/io/results/tracks_csv.h>
#include <ceres_ed/report/view/scene.h>

#include <map>
#include <vector>

namespace ceres_ed {

// A page shows at most about this many points of a map, moments and pixels across of a picture: few
// enough that ed_slam --html adds little to the time and the memory of a run.
inline constexpr int kMaxMapPoints = 6000;
inline constexpr int kMaxMoments = 30;
inline constexpr int kMaxPictureWidth = 480;

// A frame that is shown.
struct SequenceMoment {
  int frame = 0;
  // The map in the camera frame; empty where no live cloud was written.
  LiveSnapshot cloud;
  // The tracking error of each point of the cloud in metres, NaN where it is unknown; empty without
  // truth.
  std::vector<double> errors;
  // The colour picture of the camera's size; empty if there is none.
  ColorImage picture;
};

// The parts of a run. What is empty is not shown.
struct SequenceParts {
  FrameLog log;
  // The camera by frame.
  std::map<int, CameraPose> map_from_camera;
  PinholeCamera camera;
  // At least one, ascending. Either all have a cloud or none.
  std::vector<SequenceMoment> moments;
  // The map after the last frame, and the standard deviation of each of its points in metres
  // (negative where it is unknown).
  MapSnapshot map;
  std::vector<double> std_dev;
  // Whether the colours of the map were seen.
  bool has_color = false;
  // The points that the user has chosen.
  std::vector<TrackPlace> tracks;
  int max_points = kMaxMapPoints;
};

// Returns the frames whose moments are shown, of `frames` (ascending): all, or `most` of them at
// equal distances, with the first and the last one.
std::vector<int> ChooseMoments(const std::vector<int>& frames, int most = kMaxMoments);

// Returns the picture with at most `width` pixels across, each of which is the mean of a square.
ColorImage ShrinkPicture(const ColorImage& picture, int width = kMaxPictureWidth);

// Returns the map in its moments, with the path of the camera, pictures and tracks, in the frame of
// the map. The only surface is the map; its fields have the keys `truth`, `motion`, `stability`,
// `last_seen`, `first_seen` and `std_dev`, as far as they are known. With live clouds a point is
// shown where it was in each moment; otherwise all stand still, and appear when they were first
// seen.
Scene MakeSequenceScene(const SequenceParts& parts);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_VIEW_SEQUENCE_VIEW_H_
