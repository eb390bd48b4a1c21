// Deformable tracking and mapping: frame by frame, the camera and the tissue that it looks at.
#ifndef CERES_ED_SLAM_SLAM_H_
#define CERES_ED_SLAM_SLAM_H_

#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/slam/map/map_memory.h>
#include <ceres_ed/slam/slam_options.h>
#include <ceres_ed/slam/slam_types.h>
#include <ceres_ed/util/status.h>

#include <memory>
#include <string>
#include <vector>

namespace ceres_ed {

class CheckpointArchive;
class DeformableMap;
class EnergyRegistry;

// Tracks and maps one sequence. Inside, lengths are in node spacings, so that nothing depends on
// the scene's scale; what goes in and out is in metres.
class DeformableSlam {
 public:
  // Error: bad options or intrinsics, unknown energies.
  static StatusOr<std::unique_ptr<DeformableSlam>> Create(const PinholeCamera& camera,
                                                          const SlamOptions& options,
                                                          const EnergyRegistry& registry);
  virtual ~DeformableSlam() = default;

  // Takes the next frame in. Never fails: the status says what became of it.
  virtual FrameReport Process(const SlamFrame& frame) = 0;

  virtual const DeformableMap& map() const = 0;
  // Metres a map unit; 0 before the first frame.
  virtual double unit() const = 0;
  // The camera after the last frame, in map units.
  virtual const CameraPose& camera_from_map() const = 0;
  // What the map holds, and what is kept of its nodes for the next frames.
  virtual MapMemory Memory() const = 0;
  // Whether the last tracked frame had data on a node, or has added it.
  virtual bool HasData(int node) const = 0;

  // Energies of LevelsOptions::energies that have not added a residual yet.
  virtual std::vector<std::string> IdleEnergies() const = 0;

  // Lets all nodes that were left behind follow, so that the map is what it would be had they moved
  // along, to the tolerance of LazyOptions. Ahead of a look at the whole map.
  virtual void CatchUp() = 0;

  // Saves all that the next frames depend on, or loads it in the place of what is there; of a run
  // with the same camera and options. Either way what the solvers keep is dropped, so that the run
  // that was saved and the one that is loaded go on alike, to the last bit.
  virtual void Exchange(CheckpointArchive* archive) = 0;

 protected:
  DeformableSlam() = default;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_SLAM_H_
