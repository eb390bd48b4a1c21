// Corners of the picture that are attached to the tissue. They follow tissue that slides along
// itself, and recognise tissue that comes back into view.
#ifndef CERES_ED_SLAM_FRAME_FEATURE_POINTS_H_
#define CERES_ED_SLAM_FRAME_FEATURE_POINTS_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/slam/frame/camera_tracker.h>
#include <ceres_ed/slam/frame/corner_descriptors.h>
#include <ceres_ed/slam/frame/map_growth.h>
#include <ceres_ed/slam/frame/observations.h>
#include <ceres_ed/slam/frame/observed_surface.h>
#include <ceres_ed/slam/frame/patch_template.h>
#include <ceres_ed/slam/frame/pixel_tracker.h>
#include <ceres_ed/slam/map/deformable_map.h>
#include <ceres_ed/slam/slam_options.h>

#include <cstddef>
#include <optional>
#include <set>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Corners of the map, each with a position on the tissue at rest and its look when it was first
// seen. Those that are found in the present picture are *followed*: from picture to picture with
// the Lucas-Kanade method, which copes with changes of the look, and then by their first look, so
// that no error accumulates. The others stay with their nodes, and are searched for when they come
// into view again.
class FeaturePoints {
 public:
  explicit FeaturePoints(const FeatureOptions& options)
      : options_(options), tracker_(options.pixels) {}

  // Follows the corners into `image`, and searches for those that have come into view. A corner for
  // which `surface` has no patch is not followed. `camera_from_map` is the predicted camera.
  // Returns false, and does not search, if most corners were not found where they were expected:
  // then the prediction is not to be relied on.
  bool Track(ColorView image,
             const ObservedSurface& surface,
             const DeformableMap& map,
             const CameraPose& camera_from_map);

  // Searches in the present picture for the corners that `camera_from_map` brings into view and
  // that are not followed, for use when Track() had a wrong prediction.
  // Returns the number of corners that were searched for.
  int Recall(const ObservedSurface& surface,
             const DeformableMap& map,
             const CameraPose& camera_from_map) {
    const int searched = Search(surface, map, camera_from_map, /*patient=*/true);
    Weigh(map, camera_from_map);
    return searched;
  }

  // Searches for the camera without a prediction: corners of the present picture are matched with
  // all that the map knows by their descriptors. Returns the pose that explains most matches, or
  // nothing if too few agree.
  std::optional<CameraPose> Recognize(const ObservedSurface& surface,
                                      const DeformableMap& map) const;

  // Returns the followed corners as point matches for the camera.
  std::vector<PointMatch> Matches(const DeformableMap& map) const;
  // Returns the followed corners as observations of a frame. Their bindings are valid until the
  // next call of a non-const function.
  std::vector<MapObservation> Observations() const;

  // Stops to follow corners whose position on the solved map is too far from where they were seen.
  // Returns the spread of the distances.
  double DropOutliers(const DeformableMap& map, double least_deviation);

  // Finds new corners in the present picture and binds them to the map.
  void Replenish(const ObservedSurface& surface, const DeformableMap& map);

  // Stops to follow all corners, for use when the camera has jumped.
  void Clear();

  // Returns the number of followed corners, and of all corners.
  int size() const { return static_cast<int>(followed_.size()); }
  int num_known() const { return static_cast<int>(features_.size() - free_.size()); }

  // Returns the bytes on the heap that grow with the map.
  std::size_t HeapBytes() const;

  // Saves the corners and the picture, or loads them and replaces the present ones.
  void Exchange(CheckpointArchive* archive);

 private:
  struct Feature {
    // The pixel in the last picture in which the corner was followed.
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
    // The position on the observed surface, in the camera frame.
    Eigen::Vector3d in_camera = Eigen::Vector3d::Zero();
    Eigen::Vector3d at_rest = Eigen::Vector3d::Zero();
    int nodes[kMaxBoundNodes];
    double weights[kMaxBoundNodes];
    // 0 for a free slot.
    int num_nodes = 0;
    // How the position at rest changes with the pixel in the picture of `patch`.
    Eigen::Matrix<double, 3, 2> rest_from_pixel = Eigen::Matrix<double, 3, 2>::Zero();
    PatchTemplate patch;
    CornerDescriptor descriptor = {};
    // How well the motion of the corner agrees with that of its neighbours, in [0, 1].
    double weight = 1.0;
    // The number of times that the corner was searched for in vain since it was last found.
    int misses = 0;
    // The order in which corners were born.
    int birth = 0;

    Binding binding() const { return {nodes, weights, num_nodes}; }
  };

  // A corner as the map and a camera predict it.
  struct Prediction {
    Eigen::Vector3d in_camera = Eigen::Vector3d::Zero();
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
    // Maps offsets in the picture of the template to offsets in the present one.
    Eigen::Matrix2d now_from_then = Eigen::Matrix2d::Identity();
    // Whether the corner is before the camera and turned toward it, at a similar scale.
    bool comparable = false;
  };

  Prediction Predict(const Feature& feature,
                     const DeformableMap& map,
                     const CameraPose& camera_from_map,
                     const PinholeCamera& camera) const;
  void Follow(const ObservedSurface& surface,
              const DeformableMap& map,
              const CameraPose& camera_from_map);
  void Bridge(const std::vector<Eigen::Vector2d>& before,
              const std::vector<Eigen::Vector2d>& predicted,
              const std::vector<std::size_t>& unknown,
              std::vector<TrackedPixel>* tracked);
  // Searches for corners that are not followed; if `patient`, also for those that were missed
  // before, and without counting that they are missed.
  // Returns the number of those.
  int Search(const ObservedSurface& surface,
             const DeformableMap& map,
             const CameraPose& camera_from_map,
             bool patient);
  void MergeDoubles();
  // Weighs the followed corners by how well their motion agrees with that of their neighbours.
  void Weigh(const DeformableMap& map, const CameraPose& camera_from_map);
  void Remove(int index);
  void Add(const Feature& feature);
  // Computes what checkpoints do not store.
  void Index();

  FeatureOptions options_;
  PixelTracker tracker_;
  // Slots, and those of them that are free.
  std::vector<Feature> features_;
  std::set<int> free_;
  // Slots of the followed corners, and whether a slot is one of them.
  std::vector<int> followed_;
  std::vector<char> is_followed_;
  // For each node, the slots of the corners that are bound most strongly to it.
  std::vector<std::vector<int>> of_node_;
  int births_ = 0;
  // The number of pictures so far, and of the corners that were followed into the last one.
  int frame_ = 0;
  int num_continued_ = 0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_FEATURE_POINTS_H_
