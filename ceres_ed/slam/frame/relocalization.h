// Judges the pose of the camera, and searches for it when the prediction was wrong.
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
  // The share of the points in view that lie on the observed surface, among those that count
  // (PoseQualityOptions::trust_gaps).
  double overlap = 0.0;
  // The share of all points in view that lie on the observed surface.
  double support = 0.0;
  // The share of the observed surface that these points cover.
  double coverage = 0.0;
  // The spread of their distances, in map units.
  double deviation = 0.0;
  // The number of points on the observed surface.
  int points = 0;

  // Returns one number by which poses are compared, in which both shares count, the smaller one
  // more; a wide spread halves it.
  double Score() const;
};

// Options of JudgePose(), and thresholds for its result.
struct PoseQualityOptions {
  // A point within this distance of its plane lies on the surface; map units, > 0, default 0.5.
  double max_distance = 0.5;
  // The spacing of the map's points, in map units, > 0; default 0.2.
  double point_spacing = 0.2;
  // Whether the absence of data is no evidence against a pose: then the overlap does not count
  // points whose pixel has no depth, nor points far behind the observed surface, before which
  // something else may stand. This must be false for a pose that nothing else supports, because a
  // wrong pose lays points there, too. Default false.
  bool trust_gaps = false;
  // A tracked pose is in doubt if its overlap is smaller, or its spread (map units) larger.
  // Defaults 0.7 and 0.15.
  double doubtful_overlap = 0.7;
  double doubtful_deviation = 0.15;
  // The thresholds that any accepted pose must meet. Defaults 0.6, 0.1, 0.2 and 0.25 map units.
  double min_overlap = 0.6;
  double min_support = 0.1;
  double min_coverage = 0.2;
  double max_deviation = 0.25;

  // Returns whether a tracked pose is in doubt.
  bool Doubts(const PoseQuality& quality) const {
    return quality.overlap < doubtful_overlap || quality.support < min_support ||
           quality.coverage < min_coverage || quality.deviation > doubtful_deviation;
  }
  // Returns whether a pose is accepted.
  bool Believes(const PoseQuality& quality) const {
    return quality.overlap >= min_overlap && quality.support >= min_support &&
           quality.coverage >= min_coverage && quality.deviation <= max_deviation;
  }
};

// Returns the quality of a pose. `visible` are the points in view from that pose, as returned by
// FindVisible().
PoseQuality JudgePose(const std::vector<VisiblePoint>& visible,
                      const CameraPose& camera_from_map,
                      const ObservedSurface& surface,
                      const PoseQualityOptions& options);

// A pose that was found by a search, and its quality.
struct Relocalization {
  CameraPose camera_from_map;
  PoseQuality quality;
};

// Returns the pose that explains most of the frame (of quality 0 if there is too little to place),
// from a search without prediction: AlignRigid() lays the map in its present deformation onto the
// observed surface, starting from `last` and from many positions and rotations.
Relocalization Relocalize(const DeformableMap& map,
                          const ObservedSurface& surface,
                          const CameraPose& last,
                          const VisibilityOptions& visibility,
                          const PoseQualityOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_RELOCALIZATION_H_
