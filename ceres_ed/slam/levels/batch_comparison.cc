#include "ceres_ed/slam/levels/batch_comparison.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ceres_ed {
namespace {

LevelsOptions ConvergedBatch(LevelsOptions options) {
  options.strategy.mode = SolveMode::kBatch;
  options.solver.max_iterations = 100;
  options.solver.function_tolerance = 1e-9;
  options.solver.gradient_tolerance = 1e-12;
  options.solver.parameter_tolerance = 1e-9;
  return options;
}

}  // namespace

StatusOr<std::unique_ptr<BatchReference>> BatchReference::Create(const LevelsOptions& options,
                                                                 const EnergyRegistry& registry) {
  StatusOr<std::unique_ptr<Levels>> batch = Levels::Create(ConvergedBatch(options), registry);
  if (!batch.ok()) return batch.status();
  return std::unique_ptr<BatchReference>(new BatchReference(*std::move(batch)));
}

BatchComparison BatchReference::Compare(const FrameObservations& observations,
                                        const DeformableMap& map) {
  BatchComparison comparison;
  DeformableMap copy = map;
  const LevelReport report = batch_->SolveLevelOne(observations, /*priors=*/nullptr, &copy);
  // Frames are rarely verified, so the data that the solver keeps for a whole map are not worth
  // their memory.
  batch_->ForgetSolvers();
  if (report.status == SolveStatus::kFailed || !(report.energy > 0.0)) return comparison;
  comparison.done = true;
  comparison.energy = report.initial_energy;
  comparison.batch_energy = report.energy;
  comparison.iterations = report.iterations;
  const int num_nodes = map.graph().num_nodes();
  for (int j = 0; j < num_nodes; ++j) {
    const double distance = (map.NodePosition(j) - copy.NodePosition(j)).norm();
    comparison.node_mean += distance / num_nodes;
    comparison.node_max = std::max(comparison.node_max, distance);
  }
  const CameraPose& ours = map.state().camera_from_map;
  const CameraPose& batch = copy.state().camera_from_map;
  constexpr double kDegreesPerRadian = 180.0 / M_PI;
  comparison.camera_deg = kDegreesPerRadian * ours.rotation.angularDistance(batch.rotation);
  // The distance between the positions of the two cameras.
  comparison.camera_distance = (ours.Inverse().translation - batch.Inverse().translation).norm();
  return comparison;
}

}  // namespace ceres_ed
