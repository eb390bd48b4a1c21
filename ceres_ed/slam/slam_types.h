// What a tracker takes of a frame, and what it reports.
#ifndef CERES_ED_SLAM_SLAM_TYPES_H_
#define CERES_ED_SLAM_SLAM_TYPES_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/util/named_values.h>

#include <array>
#include <string>

namespace ceres_ed {

// One frame as it comes from a sensor. Lengths in metres.
struct SlamFrame {
  int number = 0;
  // Of the camera's size; a pointer to a DepthImage will do, or pixels that are elsewhere.
  DepthView depth;
  // Empty: none.
  ColorView color;
  // For CameraMode::kGiven.
  const CameraPose* world_from_camera = nullptr;
  // Whether all of the map will be asked for after this frame.
  bool catch_up = false;
};

enum class FrameStatus {
  // Camera and tissue were followed.
  kTracked,
  // The first frame that had something to show.
  kInitialized,
  // The camera had jumped and was found again.
  kRelocalized,
  // Camera not found: the map is as it was.
  kLost,
  // Nothing that could be used in this frame.
  kSkipped,
};

constexpr std::array<NamedValue<FrameStatus>, 5> NamesOf(FrameStatus) {
  return {{{"tracked", FrameStatus::kTracked},
           {"initialized", FrameStatus::kInitialized},
           {"relocalized", FrameStatus::kRelocalized},
           {"lost", FrameStatus::kLost},
           {"skipped", FrameStatus::kSkipped}}};
}

// Lengths are in map units.
struct BatchComparison {
  // False where there was nothing to compare, or the batch solve failed.
  bool done = false;
  // Of all residuals of the frame's last problem: as the levels left it, and at the minimum.
  double energy = 0.0;
  double batch_energy = 0.0;
  // Between the places of all nodes, g_j + t_j.
  double node_mean = 0.0;
  double node_max = 0.0;
  double camera_deg = 0.0;
  double camera_distance = 0.0;
  int iterations = 0;

  // (E - E_batch) / E_batch.
  double Gap() const { return (energy - batch_energy) / batch_energy; }
};

// Wall time of a frame's stages, seconds.
struct FrameTimes {
  double observe = 0.0;
  double associate = 0.0;
  double features = 0.0;
  double camera = 0.0;
  double level1 = 0.0;
  double level2 = 0.0;
  double warp = 0.0;
  double grow = 0.0;
  double verify = 0.0;
};

struct FrameReport {
  int number = 0;
  FrameStatus status = FrameStatus::kSkipped;
  FrameTimes times;
  int nodes = 0;
  // PR nodes, and all that Level I has moved.
  int point_relevant = 0;
  int active = 0;
  // PI nodes that Level I has moved by back-substitution, where it marginalises.
  int marginalized = 0;
  // PI nodes that Level II has moved, counted by wave.
  int updated_pi = 0;
  // Map points with an observation in this frame, and all.
  int points = 0;
  int map_points = 0;
  int inliers = 0;
  int features = 0;
  // Of the inliers' distances to their planes, metres.
  double rms_plane = 0.0;
  // Of Level I, no unit.
  double energy = 0.0;
  int iterations = 0;
  // The residual of an energy of the user's that could not be used, in a sentence that names it;
  // empty where there was none. What it was part of has not moved.
  std::string fault;
  // Of frames that were verified.
  BatchComparison batch;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_SLAM_TYPES_H_
