// How far the levels of a frame ended from the batch solve of the same problem.
#ifndef CERES_ED_SLAM_LEVELS_BATCH_COMPARISON_H_
#define CERES_ED_SLAM_LEVELS_BATCH_COMPARISON_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/slam/levels/levels.h>
#include <ceres_ed/slam/map/deformable_map.h>
#include <ceres_ed/slam/slam_options.h>
#include <ceres_ed/slam/slam_types.h>
#include <ceres_ed/util/status.h>

#include <memory>

namespace ceres_ed {

// Solves the batch problem, every node and the camera at once, on a copy, until nothing moves any
// more.
class BatchReference {
 public:
  // `options`: those of the levels that are held against it.
  static StatusOr<std::unique_ptr<BatchReference>> Create(const LevelsOptions& options,
                                                          const EnergyRegistry& registry);

  // `map`: as the levels left it, with nothing left behind; its node prior, and `observations`, are
  // those of the frame's last Level I.
  BatchComparison Compare(const FrameObservations& observations, const DeformableMap& map);

 private:
  explicit BatchReference(std::unique_ptr<Levels> batch) : batch_(std::move(batch)) {}

  std::unique_ptr<Levels> batch_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_LEVELS_BATCH_COMPARISON_H_
