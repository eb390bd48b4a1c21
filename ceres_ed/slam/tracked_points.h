// Places that a user has named, which are tracked with the tissue.
#ifndef CERES_ED_SLAM_TRACKED_POINTS_H_
#define CERES_ED_SLAM_TRACKED_POINTS_H_

#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/slam/frame/visibility.h>
#include <ceres_ed/slam/slam.h>
#include <ceres_ed/util/status.h>

#include <array>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A place that a user has named.
struct NamedPoint {
  int id = 0;
  // The position in the camera frame, in metres.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

// The position of a tracked place in a frame.
struct TrackedPlace {
  // The position in the camera frame of that frame, in metres.
  Eigen::Vector3d in_camera = Eigen::Vector3d::Zero();
  // Whether the place is in the picture, faces the camera and is not behind the map.
  bool visible = false;
};

// Options of TrackedPoints::Bind().
struct TrackedPointsOptions {
  // The largest distance from the nearest map point at the time of binding, in node spacings, > 0;
  // default 1.
  double max_distance = 1.0;
  VisibilityOptions visibility;
};

// Places that are bound to the map. Their bindings never change, so that a place follows from the
// map and the camera after a frame.
class TrackedPoints {
 public:
  TrackedPoints() = default;

  // Returns `points` bound to the map of `slam`. They must be given in the camera frame of the last
  // processed frame. It is an error if a point is too far from the visible part of the map; the
  // message names the point.
  static StatusOr<TrackedPoints> Bind(const std::vector<NamedPoint>& points,
                                      const DeformableSlam& slam,
                                      const PinholeCamera& camera,
                                      const TrackedPointsOptions& options = {});

  // Returns the present positions of the points, in the given order.
  std::vector<TrackedPlace> Locate(const DeformableSlam& slam, const PinholeCamera& camera) const;

  int size() const { return static_cast<int>(points_.size()); }
  int id(int i) const { return points_[i].id; }

  // Saves or loads everything except the options.
  void Exchange(CheckpointArchive* archive);

 private:
  // One place; lengths are in map units.
  struct Point {
    int id = 0;
    Eigen::Vector3d at_rest = Eigen::Vector3d::Zero();
    // The normal of the nearest map point.
    Eigen::Vector3d normal_at_rest = Eigen::Vector3d::Zero();
    std::array<int, kMaxBoundNodes> nodes = {};
    std::array<double, kMaxBoundNodes> weights = {};
    int num_nodes = 0;

    Binding binding() const { return {nodes.data(), weights.data(), num_nodes}; }
  };

  TrackedPointsOptions options_;
  std::vector<Point> points_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_TRACKED_POINTS_H_
