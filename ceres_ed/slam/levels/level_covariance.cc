#include "ceres_ed/slam/levels/level_covariance.h"

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/slam/levels/levels.h>
#include <ceres_ed/slam/levels/window_observations.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

// No sensor is better than this, in map units.
constexpr double kLeastDeviation = 1e-4;

Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d cross;
  cross << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return cross;
}

// Returns the robust deviation of the distances from the planes.
double PlaneDeviation(const FrameObservations& observations, const DeformableMap& map) {
  const CameraPose& camera_from_map = map.state().camera_from_map;
  std::vector<double> distances;
  distances.reserve(observations.planes.size());
  for (const MapObservation& o : observations.planes) {
    const Eigen::Vector3d place = WarpPoint(map.graph(), map.state(), o.binding, o.position);
    distances.push_back(o.normal.dot(camera_from_map * place - o.target));
  }
  return std::max(RobustDeviation(std::move(distances)), kLeastDeviation);
}

}  // namespace

Eigen::Matrix<double, 6, 6> MapFromCameraJacobian(const CameraPose& camera_from_map) {
  // With a rotation vector w of camera_from_map = (R, t) and a change dt, the centre -R^T t moves
  // by -R^T ([t] w + dt), and the rotation R^T is followed by exp(-[w]).
  const Eigen::Matrix3d map_from_camera = camera_from_map.rotation.conjugate().toRotationMatrix();
  Eigen::Matrix<double, 6, 6> jacobian = Eigen::Matrix<double, 6, 6>::Zero();
  jacobian.topLeftCorner<3, 3>() =
      -2.0 * map_from_camera * CrossMatrix(camera_from_map.translation);
  jacobian.topRightCorner<3, 3>() = -map_from_camera;
  jacobian.bottomLeftCorner<3, 3>() = -2.0 * Eigen::Matrix3d::Identity();
  return jacobian;
}

LevelCovariance::LevelCovariance(std::unique_ptr<const LevelWindow> window, StateCovariance nodes)
    : window_(std::move(window)), nodes_(std::move(nodes)) {
  for (int i = 0; i < window_->num_variable; ++i) local_[window_->nodes[i]] = i;
}

LevelCovariance::Matrix6d LevelCovariance::MapFromCamera() const {
  const Matrix6d jacobian = MapFromCameraJacobian(window_->state.camera_from_map);
  return jacobian * nodes_.Camera() * jacobian.transpose();
}

Eigen::Matrix3d LevelCovariance::Point(const Eigen::Vector3d& position,
                                       const PointBinding& binding) const {
  int nodes[kMaxBoundNodes];
  for (int i = 0; i < binding.size; ++i) {
    const auto found = local_.find(binding.nodes[i]);
    if (found == local_.end()) {
      return Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
    }
    nodes[i] = found->second;
  }
  return nodes_.Point(position, Binding{nodes, binding.weights, binding.size});
}

StatusOr<std::unique_ptr<LevelCovariance>> Levels::MeasureLevelOne(
    const FrameObservations& observations,
    const std::vector<int>& slots,
    const DeformableMap& map) {
  auto window = std::make_unique<LevelWindow>(
      windows_.Build(map.graph(), map.state(), moved_.nodes(), point_relevant_.nodes()));
  const WindowObservations seen(observations, windows_, map, *window);
  const std::vector<Eigen::Vector3d> previous = PreviousOf(*window, map);
  ProblemBuilder builder(window->graph, /*has_camera=*/true);
  terms_.AddTo(
      LevelOneInputs(observations, seen, *window, previous), TermLevels::kLevelOne, &builder);
  // The planes of a node are one measurement with this deviation. The pose prior has one of its
  // own.
  const double deviation = PlaneDeviation(observations, map);
  const double scale = 1.0 / (deviation * deviation * std::max(options_.plane_weight, 1e-12));
  for (int term = 0; term < terms_.size(); ++term) {
    if (terms_.spec(term).label == kPosePrior) continue;
    builder.SetWeight(term, scale * builder.weight(term));
  }
  const ProblemConfig config =
      window->Config(options_.camera_variable, options_.strategy.boundary_edges);
  Skinning wanted(map.neighbors());
  for (const int slot : slots) {
    const PointBinding binding = map.binding(slot);
    int nodes[kMaxBoundNodes];
    for (int i = 0; i < binding.size; ++i) nodes[i] = windows_.Local(binding.nodes[i]);
    const bool is_inside =
        std::all_of(nodes, nodes + binding.size, [](int node) { return node >= 0; });
    if (is_inside) wanted.Add(nodes, binding.weights, binding.size);
  }
  StatusOr<StateCovariance> covariance = StateCovariance::Compute(
      builder, config, window->state, {&wanted, options_.solver.num_threads});
  if (!covariance.ok()) return covariance.status();
  return std::make_unique<LevelCovariance>(std::move(window), *std::move(covariance));
}

}  // namespace ceres_ed
