#include "ceres_ed/slam/slam.h"

#include <ceres_ed/slam/tracker.h>
#include <ceres_ed/util/option_check.h>

#include <cmath>

#include <cost_functions/node_parameters.h>

namespace ceres_ed {

std::string FrameStatusName(FrameStatus status) {
  switch (status) {
    case FrameStatus::kTracked:
      return "tracked";
    case FrameStatus::kInitialized:
      return "initialized";
    case FrameStatus::kRelocalized:
      return "relocalized";
    case FrameStatus::kLost:
      return "lost";
    case FrameStatus::kSkipped:
      return "skipped";
  }
  return "skipped";
}

bool SlamOptions::IsValid(std::string* error) const {
  const auto require = [error](bool holds, const char* option, double value, const char* expected) {
    return RequireOption(holds, option, value, expected, error);
  };
  return require(node_spacing >= 0.0 && std::isfinite(node_spacing),
                 "node_spacing",
                 node_spacing,
                 "metres >= 0") &&
         require(nodes_in_view >= 4, "nodes_in_view", nodes_in_view, ">= 4") &&
         require(neighbors >= 1 && neighbors <= kMaxBoundNodes, "neighbors", neighbors, "1 to 8") &&
         require(rounds >= 1, "rounds", rounds, ">= 1") &&
         require(max_observations >= 100, "max_observations", max_observations, ">= 100") &&
         require(max_point_weight >= 1.0, "max_point_weight", max_point_weight, ">= 1") &&
         require(verify_every >= 0, "verify_every", verify_every, ">= 0") &&
         require(num_threads >= 1, "num_threads", num_threads, ">= 1") &&
         require(surface.cell >= 1, "surface.cell", surface.cell, ">= 1") &&
         require(surface.radius >= 1, "surface.radius", surface.radius, ">= 1") &&
         require(growth.point_spacing > 0.0, "growth.point_spacing", growth.point_spacing, "> 0") &&
         require(growth.node_coverage > 0.0, "growth.node_coverage", growth.node_coverage, "> 0") &&
         require(feature.count >= 0, "feature.count", feature.count, ">= 0") &&
         levels.IsValid(error);
}

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
