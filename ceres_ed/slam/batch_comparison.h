// How far the levels of a frame ended from the batch solve of the same problem.
#ifndef CERES_ED_SLAM_BATCH_COMPARISON_H_
#define CERES_ED_SLAM_BATCH_COMPARISON_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/slam/deformable_map.h>
#include <ceres_ed/slam/levels.h>
#include <ceres_ed/util/status.h>

#include <memory>

namespace ceres_ed {

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

#endif  // CERES_ED_SLAM_BATCH_COMPARISON_H_
