// The names of modes in reports.
#ifndef CERES_ED_PIPELINE_MODE_NAMES_H_
#define CERES_ED_PIPELINE_MODE_NAMES_H_

#include <ceres_ed/slam/slam_options.h>
#include <ceres_ed/solver/solver_types.h>

#include <string>

namespace ceres_ed {

inline std::string SolveModeName(SolveMode mode) {
  if (mode == SolveMode::kBatch) return "batch";
  return mode == SolveMode::kTwoLevel ? "two_level" : "marginal";
}

inline std::string CameraModeName(CameraMode mode) {
  if (mode == CameraMode::kEstimate) return "estimate";
  return mode == CameraMode::kFixed ? "fixed" : "given";
}

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_MODE_NAMES_H_
