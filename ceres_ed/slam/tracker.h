// The tracker behind DeformableSlam: the stages of a frame, and the state that is kept from frame
// to frame.
#ifndef CERES_ED_SLAM_TRACKER_H_
#define CERES_ED_SLAM_TRACKER_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/slam/frame/camera_tracker.h>
#include <ceres_ed/slam/frame/feature_points.h>
#include <ceres_ed/slam/frame/foreground.h>
#include <ceres_ed/slam/frame/map_growth.h>
#include <ceres_ed/slam/frame/observed_surface.h>
#include <ceres_ed/slam/frame/visibility.h>
#include <ceres_ed/slam/levels/batch_comparison.h>
#include <ceres_ed/slam/levels/common_motion.h>
#include <ceres_ed/slam/levels/levels.h>
#include <ceres_ed/slam/map/deformable_map.h>
#include <ceres_ed/slam/map/point_covariances.h>
#include <ceres_ed/slam/map/tissue_memory.h>
#include <ceres_ed/slam/slam.h>
#include <ceres_ed/util/status.h>

#include <memory>
#include <string>
#include <vector>

namespace ceres_ed {

// Returns `options` with settings that belong to all stages copied to each of them: the number of
// threads, and whether the levels move the camera.
SlamOptions WithSharedSettings(SlamOptions options);

// The implementation of DeformableSlam.
class Tracker final : public DeformableSlam {
 public:
  Tracker(const PinholeCamera& camera, const SlamOptions& options);

  // Creates the levels. It is an error if an energy or a parameter is unknown.
  Status AddLevels(const EnergyRegistry& registry);

  FrameReport Process(const SlamFrame& frame) override;
  const DeformableMap& map() const override { return map_; }
  double unit() const override { return unit_; }
  const CameraPose& camera_from_map() const override { return map_.state().camera_from_map; }
  MaskImage ForegroundMask() const override { return foreground_.Mask(); }
  MapMemory Memory() const override;
  bool HasData(int node) const override {
    return levels_->point_relevant().Has(node) || node >= nodes_before_growth_;
  }
  Eigen::Matrix3d PointCovariance(int slot) const override { return covariances_.At(slot, map_); }
  std::vector<std::string> IdleEnergies() const override { return levels_->IdleEnergies(); }
  void CatchUp() override { levels_->CatchUp(/*priors=*/nullptr, &map_); }
  void Exchange(CheckpointArchive* archive) override;

 private:
  void Initialize(const SlamFrame& frame);
  ObservedSurface Smooth(const SlamFrame& frame, double scale, int radius) const;
  CameraPose Predict(const SlamFrame& frame) const;
  bool FindCamera(const SlamFrame& frame, const ObservedSurface& surface, FrameReport* report);
  int FindCorners(const ObservedSurface& surface,
                  const CameraPose& start,
                  std::vector<PointMatch>* matches,
                  CameraTrackerResult* tracked,
                  FrameReport* report);
  void FindCameraAnew(const ObservedSurface& surface,
                      std::vector<PointMatch>* matches,
                      CameraTrackerResult* tracked,
                      FrameReport* report);
  bool Confirm(const ObservedSurface& surface,
               const std::vector<PointMatch>& matches,
               const CameraPose& before,
               bool smooth,
               CameraPose* pose,
               FrameReport* report);
  // Brings the nodes near the view up to date.
  void CatchUpInView(const CameraPose& camera_from_map, FrameReport* report);
  bool IsTissueStill(const AssociationResult& association, const ObservedSurface& surface) const;
  FrameObservations FollowSeen(const ObservedSurface& surface, FrameReport* report);
  // Computes the covariances of a frame from its last Level I.
  void MeasureCovariances(const FrameObservations& observations, FrameReport* report);
  void FollowHidden(bool catch_up, FrameReport* report);
  void Deform(const ObservedSurface& surface, bool catch_up, FrameReport* report);
  void RemoveForeground(ObservedSurface* surface, FrameReport* report);
  void FollowTissue(const ObservedSurface& surface, bool catch_up, FrameReport* report);
  void NoteRecalled();
  void NoteNewNodes();
  double FeatureDeviation() const;
  double NodePriorShare() const;
  void Measure(const AssociationResult& association, double noise, FrameReport* report);
  void Fuse(const AssociationResult& association, int frame, double noise);
  // Notes that a visible point, whose data are `point`, is not where it should be, and removes it
  // if this has happened too often. Its slot in visible_ is -1 then.
  void Contradict(int visible, MapPoint point);
  void Verify(const FrameObservations& observations, FrameReport* report);
  void Grow(const SlamFrame& frame, const ObservedSurface& surface, FrameReport* report);
  FrameObservations Observe(const AssociationResult& association) const;

  PinholeCamera camera_;
  SlamOptions options_;
  std::unique_ptr<Levels> levels_;
  // Null if no frame is verified.
  std::unique_ptr<BatchReference> batch_;
  DeformableMap map_;
  FeaturePoints features_;
  Foreground foreground_;
  TissueMemory memory_;
  double unit_ = 0.0;
  // The radius in pixels of the patches of a frame, which depends on the noise of the first frame.
  int surface_radius_ = 0;
  std::vector<VisiblePoint> visible_;
  // In metres. The map frame is the frame of the first camera.
  CameraPose world_from_map_;
  // The number of points on the observed surface in the last tracked frame.
  int points_before_ = 0;
  // The number of frames in which a pose that was found by a search must still prove itself. Until
  // then the map stays as it is.
  int proving_ = 0;
  // Whether the camera of the frame before is not known.
  bool gap_ = false;
  // The number of nodes at the start of the last growth.
  int nodes_before_growth_ = 0;
  PointCovariances covariances_;
  // With covariances: the nodes of the visible points ahead of this frame's Level I.
  NodePlaces nodes_before_;
  // Whether the tissue seemed still in the last frame that was followed.
  bool was_still_ = true;
  // The last motion of the camera, along the directions that the data determined.
  CameraPose camera_step_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_TRACKER_H_
