// Deformable tracking and mapping: frame by frame, the camera and the tissue that it looks at.
#ifndef CERES_ED_SLAM_SLAM_H_
#define CERES_ED_SLAM_SLAM_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/slam/batch_comparison.h>
#include <ceres_ed/slam/camera_tracker.h>
#include <ceres_ed/slam/deformable_map.h>
#include <ceres_ed/slam/feature_points.h>
#include <ceres_ed/slam/levels.h>
#include <ceres_ed/slam/map_growth.h>
#include <ceres_ed/slam/observed_surface.h>
#include <ceres_ed/slam/tissue_memory.h>
#include <ceres_ed/slam/visibility.h>
#include <ceres_ed/solver/strategy.h>
#include <ceres_ed/util/status.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ceres_ed {

// What decides where the camera is.
enum class CameraMode {
  // Rigid alignment first, then along with the nodes, under a pose prior.
  kEstimate,
  // It never moves.
  kFixed,
  // The poses that come with the frames.
  kGiven,
};

struct SlamOptions {
  SolveMode mode = SolveMode::kTwoLevel;
  // Of Level I, >= 0.
  int rings = 2;
  SeamEdges seam_edges = SeamEdges::kKeep;
  CameraMode camera = CameraMode::kEstimate;
  // Metres; 0 = so that about `nodes_in_view` nodes cover what the first frame shows.
  double node_spacing = 0.0;
  int nodes_in_view = 250;
  // Nodes that carry a point, in [1, kMaxBoundNodes].
  int neighbors = 4;
  // Follow corners of the colour image, where there is one.
  bool features = true;
  // Times at most that a frame is associated and Level I takes a step, >= 1.
  int rounds = 4;
  // Observations that Level I takes, evenly chosen among more, >= 100.
  int max_observations = 6000;
  // Number of observations after which the running average of a point forgets, >= 1.
  double max_point_weight = 20.0;
  TissueMemoryOptions memory;
  // Hold every n-th frame against the batch solve of its last problem, on a copy; 0 = none.
  int verify_every = 0;
  int num_threads = 1;
  LevelsOptions levels;
  FeatureOptions feature;
  MapGrowthOptions growth;
  ObservedSurfaceOptions surface;

  // False, with the option and what was expected in `error`, when a value is out of range.
  bool IsValid(std::string* error) const;
};

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

std::string FrameStatusName(FrameStatus status);

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

// Tracks and maps one sequence. Inside, lengths are in node spacings, so that nothing depends on
// the scene's scale; what goes in and out is in metres.
class DeformableSlam {
 public:
  // Error: bad options or intrinsics, unknown energies.
  static StatusOr<std::unique_ptr<DeformableSlam>> Create(const PinholeCamera& camera,
                                                          const SlamOptions& options,
                                                          const EnergyRegistry& registry);

  // Takes the next frame in. Never fails: the status says what became of it.
  FrameReport Process(const SlamFrame& frame);

  const DeformableMap& map() const { return map_; }
  // Metres a map unit; 0 before the first frame.
  double unit() const { return unit_; }
  // The camera after the last frame, in map units.
  const CameraPose& camera_from_map() const { return map_.state().camera_from_map; }
  // What the map holds, and what is kept of its nodes for the next frames.
  MapMemory Memory() const;
  // Whether the last tracked frame had data on a node, or has added it.
  bool HasData(int node) const {
    return levels_->point_relevant().Has(node) || node >= nodes_before_growth_;
  }

  // Energies of LevelsOptions::energies that have not added a residual yet.
  std::vector<std::string> IdleEnergies() const { return levels_->IdleEnergies(); }

  // Lets all nodes that were left behind follow, so that the map is what it would be had they moved
  // along, to the tolerance of LazyOptions. Ahead of a look at the whole map.
  void CatchUp() { levels_->CatchUp(/*priors=*/nullptr, &map_); }

  // Saves all that the next frames depend on, or loads it in the place of what is there; of a run
  // with the same camera and options. Either way what the solvers keep is dropped, so that the run
  // that was saved and the one that is loaded go on alike, to the last bit.
  void Exchange(CheckpointArchive* archive);

 private:
  DeformableSlam(const PinholeCamera& camera, const SlamOptions& options);

  void Initialize(const SlamFrame& frame);
  CameraPose Predict(const SlamFrame& frame) const;
  bool FindCamera(const SlamFrame& frame, const ObservedSurface& surface, FrameReport* report);
  bool Confirm(const ObservedSurface& surface,
               const CameraPose& before,
               CameraPose* pose,
               FrameReport* report);
  // Returns the number of nodes that it has moved.
  int CatchUpInView(const CameraPose& camera_from_map);
  FrameObservations FollowSeen(const ObservedSurface& surface, FrameReport* report);
  void FollowHidden(bool catch_up, FrameReport* report);
  void FollowTissue(const ObservedSurface& surface, bool catch_up, FrameReport* report);
  void NoteRecalled();
  void NoteNewNodes();
  double FeatureDeviation() const;
  void Measure(const AssociationResult& association, double noise, FrameReport* report);
  void Fuse(const AssociationResult& association, double noise);
  void Verify(const FrameObservations& observations, FrameReport* report);
  void Grow(const SlamFrame& frame, const ObservedSurface& surface, FrameReport* report);
  FrameObservations Observe(const AssociationResult& association) const;

  PinholeCamera camera_;
  SlamOptions options_;
  std::unique_ptr<Levels> levels_;
  // Null where no frame is verified.
  std::unique_ptr<BatchReference> batch_;
  DeformableMap map_;
  FeaturePoints features_;
  TissueMemory memory_;
  double unit_ = 0.0;
  std::vector<VisiblePoint> visible_;
  // Metres. The map's frame is that of the first camera.
  CameraPose world_from_map_;
  // Points on the observed surface in the last frame that was tracked.
  int points_before_ = 0;
  // Nodes that it started with.
  int nodes_before_growth_ = 0;
  // The last step of the camera, for the prediction of the next.
  CameraPose camera_step_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_SLAM_H_
