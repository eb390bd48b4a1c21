// Where the camera is when it isn't where it was thought to be.
#ifndef CERES_ED_SLAM_FRAME_RELOCALIZATION_H_
#define CERES_ED_SLAM_FRAME_RELOCALIZATION_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/slam/frame/camera_tracker.h>
#include <ceres_ed/slam/frame/observed_surface.h>
#include <ceres_ed/slam/frame/visibility.h>
#include <ceres_ed/slam/map/deformable_map.h>

#include <vector>

namespace ceres_ed {

// How well a pose explains a frame.
struct PoseQuality {
  // Of the map's points that should be in view, the share that lies on the observed surface.
  double overlap = 0.0;
  // Of the observed surface, the share that such points cover.
  double coverage = 0.0;
  // Spread of their distances, map units.
  double deviation = 0.0;
  // Points on the observed surface.
  int points = 0;

  // One number to compare poses by: both shares count, the smaller one more, and a wide spread
  // halves it.
  double Score() const;
};

struct PoseQualityOptions {
  // A point within this distance of its plane lies on the surface, map units, > 0.
  double max_distance = 0.5;
  // Between points of the map, map units, > 0.
  double point_spacing = 0.2;
  // A pose that was tracked is in doubt when less overlaps, or when points spread wider (map
  // units).
  double doubtful_overlap = 0.7;
  double doubtful_deviation = 0.15;
  // What any pose must reach to be believed.
  double min_overlap = 0.6;
  double min_coverage = 0.2;
  double max_deviation = 0.25;

  bool Doubts(const PoseQuality& quality) const {
    return quality.overlap < doubtful_overlap || quality.coverage < min_coverage ||
           quality.deviation > doubtful_deviation;
  }
  bool Believes(const PoseQuality& quality) const {
    return quality.overlap >= min_overlap && quality.coverage >= min_coverage &&
           quality.deviation <= max_deviation;
  }
};

// `visible`: the points in view from the pose, as of FindVisible().
PoseQuality JudgePose(const std::vector<VisiblePoint>& visible,
                      const CameraPose& camera_from_map,
                      const ObservedSurface& surface,
                      const PoseQualityOptions& options);

struct Relocalization {
  CameraPose camera_from_map;
  PoseQuality quality;
};

// Returns the pose that explains most, looked for from scratch: the map as it is deformed now is
// laid on the observed surface by AlignRigid(), from `last` and from many places and turns.
Relocalization Relocalize(const DeformableMap& map,
                          const ObservedSurface& surface,
                          const CameraPose& last,
                          const VisibilityOptions& visibility,
                          const PoseQualityOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_RELOCALIZATION_H_
