// Deformable tracking and mapping: estimates the camera and the tissue in front of it, frame by
// frame.
#ifndef CERES_ED_SLAM_SLAM_H_
#define CERES_ED_SLAM_SLAM_H_

#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/slam/slam_options.h>
#include <ceres_ed/slam/slam_types.h>
#include <ceres_ed/util/status.h>

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

class CheckpointArchive;
class DeformableMap;
class EnergyRegistry;

// Tracks and maps one sequence. Internally lengths are in node spacings, so that nothing depends on
// the scale of the scene; inputs and outputs are in metres.
class DeformableSlam {
 public:
  // Returns a new tracker. It is an error if an option or the intrinsics are invalid, or if an
  // energy is unknown.
  static StatusOr<std::unique_ptr<DeformableSlam>> Create(const PinholeCamera& camera,
                                                          const SlamOptions& options,
                                                          const EnergyRegistry& registry);
  virtual ~DeformableSlam() = default;

  // Processes the next frame. It never fails; the status of the report says what happened.
  virtual FrameReport Process(const SlamFrame& frame) = 0;

  // Returns the map, in map units.
  virtual const DeformableMap& map() const = 0;
  // Returns the length of a map unit in metres; 0 before the first frame.
  virtual double unit() const = 0;
  // Returns the camera pose after the last frame, in map units.
  virtual const CameraPose& camera_from_map() const = 0;
  // Returns the pixels of the last frame in which something else, such as a tool, stands before the
  // tissue: they are 1, and were not used. All others are 0.
  virtual MaskImage ForegroundMask() const = 0;
  // Returns the memory of the map and of the data that are kept of its nodes for the next frames.
  virtual MapMemory Memory() const = 0;
  // Returns whether the last tracked frame had data on a node, or has added the node.
  virtual bool HasData(int node) const = 0;

  // Returns the covariance of a point of the map, by its slot, in the map frame and in squared map
  // units, as the last frame left it whose Level I has moved all nodes of the point
  // (LevelCovariance). NaN if there was none, or without SlamOptions::covariance.
  virtual Eigen::Matrix3d PointCovariance(int slot) const = 0;

  // Returns the energies of LevelsOptions::energies that have not added a residual yet.
  virtual std::vector<std::string> IdleEnergies() const = 0;

  // Moves all nodes that lazy Level II has not moved yet, so that the whole map is up to date
  // within the tolerance of LazyOptions. Call it before the whole map is used.
  virtual void CatchUp() = 0;

  // Saves everything on which the next frames depend, or loads it and replaces the present state. A
  // checkpoint must come from a run with the same camera and options. In both cases data that the
  // solvers keep are discarded, so that the saved run and the loaded run continue identically, to
  // the last bit.
  virtual void Exchange(CheckpointArchive* archive) = 0;

 protected:
  DeformableSlam() = default;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_SLAM_H_
