#include "ceres_ed/slam/slam.h"

#include <ceres_ed/slam/tracker.h>

namespace ceres_ed {

StatusOr<std::unique_ptr<DeformableSlam>> DeformableSlam::Create(const PinholeCamera& camera,
                                                                 const SlamOptions& options,
                                                                 const EnergyRegistry& registry) {
  std::string error;
  if (!camera.IsValid(&error)) return Status::Error("camera: " + error);
  if (!options.IsValid(&error)) return Status::Error(error);
  auto tracker = std::make_unique<Tracker>(camera, options);
  Status status = tracker->AddLevels(registry);
  if (!status.ok()) return status;
  return StatusOr<std::unique_ptr<DeformableSlam>>(std::move(tracker));
}

}  // namespace ceres_ed
