// Corners of the picture that are attached to the tissue. They follow tissue that slides along
// itself, and recognise tissue that comes back into view.
#ifndef CERES_ED_SLAM_FRAME_FEATURE_POINTS_H_
#define CERES_ED_SLAM_FRAME_FEATURE_POINTS_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/slam/frame/camera_tracker.h>
#include <ceres_ed/slam/frame/corner_store.h>
#include <ceres_ed/slam/frame/map_growth.h>
#include <ceres_ed/slam/frame/observations.h>
#include <ceres_ed/slam/frame/observed_surface.h>
#include <ceres_ed/slam/frame/pixel_tracker.h>
#include <ceres_ed/slam/map/deformable_map.h>
#include <ceres_ed/slam/slam_options.h>

#include <cstddef>
#include <optional>
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
  int size() const { return static_cast<int>(corners_.followed().size()); }
  int num_known() const { return corners_.num_corners(); }

  // Returns the bytes on the heap that grow with the map.
  std::size_t HeapBytes() const { return corners_.HeapBytes(); }

  // Saves the corners and the picture, or loads them and replaces the present ones.
  void Exchange(int num_nodes, CheckpointArchive* archive);

 private:
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

  FeatureOptions options_;
  PixelTracker tracker_;
  CornerStore corners_;
  // The number of pictures so far, and of the corners that were followed into the last one.
  int frame_ = 0;
  int num_continued_ = 0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_FEATURE_POINTS_H_
