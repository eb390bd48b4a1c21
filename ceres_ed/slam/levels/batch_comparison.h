// Compares the result of the levels in a frame with the batch solution of the same problem.
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

// Solves the batch problem (all nodes and the camera together) on a copy of the map until it has
// converged.
class BatchReference {
 public:
  // Returns a reference solver. `options` are those of the levels that are compared with it.
  static StatusOr<std::unique_ptr<BatchReference>> Create(const LevelsOptions& options,
                                                          const EnergyRegistry& registry);

  // Compares the result of the levels with the batch solution. `map` must be the map after the
  // levels, with all nodes up to date. Its node prior, and `observations`, must be those of the
  // last Level I of the frame.
  BatchComparison Compare(const FrameObservations& observations, const DeformableMap& map);

 private:
  explicit BatchReference(std::unique_ptr<Levels> batch) : batch_(std::move(batch)) {}

  std::unique_ptr<Levels> batch_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_LEVELS_BATCH_COMPARISON_H_
