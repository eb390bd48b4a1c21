// The frames of a sequence, as a view shows them beside the map.
#ifndef CERES_ED_REPORT_VIEW_TIMELINE_H_
#define CERES_ED_REPORT_VIEW_TIMELINE_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/graph/deformation_state.h>

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

struct TimelineFrame {
  int number = 0;
  // "tracked", "lost" and so on.
  std::string status;
  // What is known of the frame, for people.
  std::string text;
  // The camera, if it is known: a point of the map is at map_from_camera * point_in_camera.
  std::optional<CameraPose> map_from_camera;
};

// A point that is followed, in a picture; in pixels.
struct PictureMark {
  int id = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

// The colour picture of a moment, made smaller; empty if there is none.
struct ViewPicture {
  ColorImage image;
  std::vector<PictureMark> marks;
};

// A point that was chosen, in the moments in which its place is known.
struct ViewTrack {
  int id = 0;
  std::vector<int> moments;
  // In the frame of the map.
  std::vector<Eigen::Vector3d> places;
};

struct Timeline {
  // All frames of the run, ascending.
  std::vector<TimelineFrame> frames;
  // The frames that are shown, as indices into `frames`, ascending; at least one.
  std::vector<int> moments;
  // The camera of the depth.
  PinholeCamera camera;
  // One for each moment.
  std::vector<ViewPicture> pictures;
  std::vector<ViewTrack> tracks;
  // What the marks in the pictures are.
  std::string marks;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_VIEW_TIMELINE_H_
