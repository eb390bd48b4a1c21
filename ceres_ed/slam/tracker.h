// The tracker behind DeformableSlam: the stages of a frame, and what goes on from frame to frame.
#ifndef CERES_ED_SLAM_TRACKER_H_
#define CERES_ED_SLAM_TRACKER_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/slam/frame/camera_tracker.h>
#include <ceres_ed/slam/frame/feature_points.h>
#include <ceres_ed/slam/frame/map_growth.h>
#include <ceres_ed/slam/frame/observed_surface.h>
#include <ceres_ed/slam/frame/visibility.h>
#include <ceres_ed/slam/levels/batch_comparison.h>
#include <ceres_ed/slam/levels/levels.h>
#include <ceres_ed/slam/map/deformable_map.h>
#include <ceres_ed/slam/map/tissue_memory.h>
#include <ceres_ed/slam/slam.h>
#include <ceres_ed/util/status.h>

#include <memory>
#include <string>
#include <vector>

namespace ceres_ed {

// Returns `options` with what is set once for all stages handed on to each: the number of threads,
// and whether the levels move the camera.
SlamOptions WithSharedSettings(SlamOptions options);

class Tracker final : public DeformableSlam {
 public:
  Tracker(const PinholeCamera& camera, const SlamOptions& options);

  // Makes the levels. Error: an unknown energy or parameter.
  Status AddLevels(const EnergyRegistry& registry);

  FrameReport Process(const SlamFrame& frame) override;
  const DeformableMap& map() const override { return map_; }
  double unit() const override { return unit_; }
  const CameraPose& camera_from_map() const override { return map_.state().camera_from_map; }
  MapMemory Memory() const override;
  bool HasData(int node) const override {
    return levels_->point_relevant().Has(node) || node >= nodes_before_growth_;
  }
  std::vector<std::string> IdleEnergies() const override { return levels_->IdleEnergies(); }
  void CatchUp() override { levels_->CatchUp(/*priors=*/nullptr, &map_); }
  void Exchange(CheckpointArchive* archive) override;

 private:
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

#endif  // CERES_ED_SLAM_TRACKER_H_
