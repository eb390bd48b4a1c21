// Corners of the picture that are attached to the tissue. They follow tissue that slides along
// itself.
#ifndef CERES_ED_SLAM_FRAME_FEATURE_POINTS_H_
#define CERES_ED_SLAM_FRAME_FEATURE_POINTS_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/slam/frame/camera_tracker.h>
#include <ceres_ed/slam/frame/map_growth.h>
#include <ceres_ed/slam/frame/observations.h>
#include <ceres_ed/slam/frame/observed_surface.h>
#include <ceres_ed/slam/frame/pixel_tracker.h>
#include <ceres_ed/slam/map/deformable_map.h>
#include <ceres_ed/slam/slam_options.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Corners that are tracked, each with a position on the map at rest.
class FeaturePoints {
 public:
  explicit FeaturePoints(const FeatureOptions& options)
      : options_(options), tracker_(options.pixels) {}

  // Tracks the corners into `image`. Corners that are lost, or for which `surface` has no patch,
  // are removed. `camera_from_map` is the predicted camera.
  void Track(ColorView image,
             const ObservedSurface& surface,
             const DeformableMap& map,
             const CameraPose& camera_from_map);

  // Returns the tracked corners as point matches for the camera.
  std::vector<PointMatch> Matches(const DeformableMap& map) const;
  // Returns the tracked corners as observations of a frame. Their bindings are valid until the next
  // call of a non-const function.
  std::vector<MapObservation> Observations() const;

  // Removes corners whose position on the solved map is too far from where they were seen. Returns
  // the spread of the distances.
  double DropOutliers(const DeformableMap& map, double least_deviation);

  // Finds new corners in the present picture and binds them to the map.
  void Replenish(const ObservedSurface& surface, const DeformableMap& map);

  // Removes all corners, for use when the camera has jumped.
  void Clear() { features_.clear(); }

  int size() const { return static_cast<int>(features_.size()); }

  // Saves the corners and the picture, or loads them and replaces the present ones.
  void Exchange(CheckpointArchive* archive);

 private:
  struct Feature {
    Eigen::Vector2d pixel;
    // The position on the observed surface, in the camera frame.
    Eigen::Vector3d in_camera;
    Eigen::Vector3d at_rest;
    int nodes[kMaxBoundNodes];
    double weights[kMaxBoundNodes];
    int num_nodes = 0;

    Binding binding() const { return {nodes, weights, num_nodes}; }
  };

  FeatureOptions options_;
  PixelTracker tracker_;
  std::vector<Feature> features_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_FEATURE_POINTS_H_
