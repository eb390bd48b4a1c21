// The input of a tracker for a frame, and its report.
#ifndef CERES_ED_SLAM_SLAM_TYPES_H_
#define CERES_ED_SLAM_SLAM_TYPES_H_

#include <ceres_ed/geometry/depth_noise.h>
#include <ceres_ed/geometry/images.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/util/named_values.h>

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>

#include <Eigen/Core>

namespace ceres_ed {

// One frame of a sensor. Lengths are in metres.
struct SlamFrame {
  // The number of the frame.
  int number = 0;
  // The depth image, of the size of the camera: a pointer to a DepthImage, or a view of other
  // pixels.
  DepthView depth;
  // The colour image; empty if there is none.
  ColorView color;
  // How uncertain the depth is. If it is not known, the noise is measured from each depth image,
  // one number for all of its pixels.
  DepthNoise noise;
  // The pose for CameraMode::kGiven; null if it is not known.
  const CameraPose* world_from_camera = nullptr;
  // Whether the whole map will be requested after this frame.
  bool catch_up = false;
};

// What happened to a frame.
enum class FrameStatus {
  // Camera and tissue were tracked.
  kTracked,
  // This is the first frame with usable depth; the map was created from it.
  kInitialized,
  // The camera had jumped and was found by a search.
  kRelocalized,
  // The camera was not found; the map is unchanged.
  kLost,
  // The frame has no usable depth.
  kSkipped,
};

// Returns the names of the values; they are part of the files that programs write.
constexpr std::array<NamedValue<FrameStatus>, 5> NamesOf(FrameStatus) {
  return {{{"tracked", FrameStatus::kTracked},
           {"initialized", FrameStatus::kInitialized},
           {"relocalized", FrameStatus::kRelocalized},
           {"lost", FrameStatus::kLost},
           {"skipped", FrameStatus::kSkipped}}};
}

// The difference between the result of the levels and the batch solution. Lengths are in map units.
struct BatchComparison {
  // False if there was nothing to compare, or if the batch solve failed.
  bool done = false;
  // The energy of all residuals of the frame's last problem: after the levels, and at the minimum.
  double energy = 0.0;
  double batch_energy = 0.0;
  // The differences of the positions g_j + t_j of all nodes, and of the camera.
  double node_mean = 0.0;
  double node_max = 0.0;
  double camera_deg = 0.0;
  double camera_distance = 0.0;
  int iterations = 0;

  // Returns the relative gap (E - E_batch) / E_batch.
  double Gap() const { return (energy - batch_energy) / batch_energy; }
};

// The wall times of the stages of a frame, in seconds.
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

// The report on one frame.
struct FrameReport {
  int number = 0;
  FrameStatus status = FrameStatus::kSkipped;
  FrameTimes times;
  int nodes = 0;
  // The number of PR nodes, and of all nodes that Level I has moved.
  int point_relevant = 0;
  int active = 0;
  // The number of PI nodes that Level I has moved by back-substitution, if it marginalises.
  int marginalized = 0;
  // The number of PI nodes that Level II has moved, summed over its waves.
  int updated_pi = 0;
  // The number of map points with an observation in this frame, and of all map points.
  int points = 0;
  int map_points = 0;
  int inliers = 0;
  int features = 0;
  // The share of the observed surface that has a counterpart in the map, and the share of the
  // points in view, where the surface is measured, that lie on it.
  double explained = 0.0;
  double overlap = 0.0;
  // The number of directions, of the 6 of the camera's motion, that the frame does not determine.
  int weak_directions = 0;
  // The share of the points in view that were seen in too few frames to be certain.
  double tentative = 0.0;
  // The share of the observed surface that stands before the tissue, such as a tool.
  double foreground = 0.0;
  // The root mean square distance of the inliers from their planes, in metres.
  double rms_plane = 0.0;
  // The energy of Level I, without unit, and the share of it that the held nodes would lose at once
  // (ActiveSetRule::kInformation; NaN if it was not measured).
  double energy = 0.0;
  double held_share = std::numeric_limits<double>::quiet_NaN();
  int iterations = 0;
  // The residual of a user's energy that could not be evaluated, in a sentence that names it; empty
  // if there was none. The level to which it belongs has not moved anything.
  std::string fault;
  // The covariance of map_from_camera (SlamOptions::covariance), in metres and radians: its
  // translation in the map frame, then a rotation vector in the camera frame. It does not exist in
  // frames without Level I.
  std::optional<Eigen::Matrix<double, 6, 6>> camera_covariance;
  // The comparison with the batch solution, in frames that were verified.
  BatchComparison batch;
};

// Bytes on the heap of everything that grows with the map: the capacity of the containers, whether
// it is used or not, rounded up like the allocator does. Temporary memory of a frame is not
// included.
struct MapMemory {
  // Rest positions, states and priors of the nodes.
  std::size_t nodes = 0;
  // Edges, and for each node the list of its edges.
  std::size_t edges = 0;
  std::size_t node_index = 0;
  // The positions of nodes at the times when they were seen (TissueMemory).
  std::size_t tissue_memory = 0;
  // The data that the levels store for every node: unsettled changes, motion, and the place in the
  // window.
  std::size_t levels = 0;

  std::size_t points = 0;
  std::size_t bindings = 0;
  // For each node the points that are bound most strongly to it, and the free slots.
  std::size_t point_lists = 0;
  // The corners of the pictures with their looks (FeaturePoints).
  std::size_t corners = 0;

  std::size_t OfNodes() const { return nodes + edges + node_index + tissue_memory + levels; }
  std::size_t OfPoints() const { return points + bindings + point_lists; }
  std::size_t Total() const { return OfNodes() + OfPoints() + corners; }
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_SLAM_TYPES_H_
