// Places that a user has named, followed along with the tissue.
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

// A place as it comes from a user.
struct NamedPoint {
  int id = 0;
  // Metres, camera frame.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

// Where a followed place is in a frame.
struct TrackedPlace {
  // Metres, camera frame of that frame.
  Eigen::Vector3d in_camera = Eigen::Vector3d::Zero();
  // In the picture, facing the camera and not behind the map.
  bool visible = false;
};

struct TrackedPointsOptions {
  // Farthest from the map's nearest point when they are bound, node spacings, > 0.
  double max_distance = 1.0;
  VisibilityOptions visibility;
};

// Places bound to the map. Their bindings never change: they need no more of a frame than what the
// map and the camera became.
class TrackedPoints {
 public:
  TrackedPoints() = default;

  // Returns `points`, given in the camera frame of the last frame that `slam` has taken in, bound
  // to its map. Error: names the point that is too far from all that the camera sees of the map.
  static StatusOr<TrackedPoints> Bind(const std::vector<NamedPoint>& points,
                                      const DeformableSlam& slam,
                                      const PinholeCamera& camera,
                                      const TrackedPointsOptions& options = {});

  // Returns where the points are now, in the order in which they were given.
  std::vector<TrackedPlace> Locate(const DeformableSlam& slam, const PinholeCamera& camera) const;

  int size() const { return static_cast<int>(points_.size()); }
  int id(int i) const { return points_[i].id; }

  // Saves everything but the options, or loads it.
  void Exchange(CheckpointArchive* archive);

 private:
  // Lengths in map units.
  struct Point {
    int id = 0;
    Eigen::Vector3d at_rest = Eigen::Vector3d::Zero();
    // Of the map's nearest point.
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
