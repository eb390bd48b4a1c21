// Corners of the picture that are held to the tissue: what follows it where it slides along itself.
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

// Corners that are being followed, each with a place on the map at rest.
class FeaturePoints {
 public:
  explicit FeaturePoints(const FeatureOptions& options)
      : options_(options), tracker_(options.pixels) {}

  // Follows the corners into `image`; those that are lost, or that land where `surface` has
  // nothing, are gone. `camera_from_map`: the predicted camera.
  void Track(ColorView image,
             const ObservedSurface& surface,
             const DeformableMap& map,
             const CameraPose& camera_from_map);

  // The corners in sight as point matches for the camera.
  std::vector<PointMatch> Matches(const DeformableMap& map) const;
  // And as observations of a frame. Bindings stay valid until the next call that isn't const.
  std::vector<MapObservation> Observations() const;

  // Drops corners whose place on the solved map is too far from where they were seen. Returns the
  // spread of what is left.
  double DropOutliers(const DeformableMap& map, double least_deviation);

  // Finds new corners of the present picture and binds them to the map.
  void Replenish(const ObservedSurface& surface, const DeformableMap& map);

  // Drops all corners: the camera has jumped.
  void Clear() { features_.clear(); }

  int size() const { return static_cast<int>(features_.size()); }

  // Saves corners and picture, or loads them in the place of what is there.
  void Exchange(CheckpointArchive* archive);

 private:
  struct Feature {
    Eigen::Vector2d pixel;
    // On the observed surface.
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
