#include "ceres_ed/slam/levels/common_motion.h"

#include <algorithm>
#include <cstddef>

#include <Eigen/Geometry>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

// What is needed of the observed places and their steps.
struct StepMoments {
  // The mean place, in the camera frame.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double square_radius = 0.0;
  double square_step = 0.0;
};

Eigen::Vector3d StepOf(const MapObservation& o,
                       const NodePlaces& before,
                       const DeformationState& state) {
  Eigen::Vector3d step = Eigen::Vector3d::Zero();
  for (int i = 0; i < o.binding.size; ++i) {
    const int node = o.binding.nodes[i];
    const Eigen::Vector3d* place = before.Find(node);
    if (place != nullptr)
      step += o.binding.weights[i] * (NodeTranslation(state.node(node)) - *place);
  }
  return step;
}

StepMoments MomentsOf(const FrameObservations& observations,
                      const NodePlaces& before,
                      const DeformationState& state) {
  StepMoments moments;
  const double share = 1.0 / static_cast<double>(observations.planes.size());
  for (const MapObservation& o : observations.planes) {
    moments.center += share * o.target;
    moments.square_step += share * StepOf(o, before, state).squaredNorm();
  }
  for (const MapObservation& o : observations.planes) {
    moments.square_radius += share * (o.target - moments.center).squaredNorm();
  }
  return moments;
}

}  // namespace

void NodePlaces::Take(const std::vector<PointBinding>& bindings, const DeformationState& state) {
  std::vector<int> nodes;
  for (const PointBinding& binding : bindings) {
    nodes.insert(nodes.end(), binding.nodes, binding.nodes + binding.size);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  places_.clear();
  for (const int node : nodes) places_.emplace_back(node, NodeTranslation(state.node(node)));
}

const Eigen::Vector3d* NodePlaces::Find(int node) const {
  const auto place =
      std::lower_bound(places_.begin(), places_.end(), node, [](const auto& entry, int number) {
        return entry.first < number;
      });
  return place != places_.end() && place->first == node ? &place->second : nullptr;
}

Matrix6d CommonMotionCovariance(const FrameObservations& observations,
                                const NodePlaces& before,
                                const DeformationState& state) {
  Matrix6d covariance = Matrix6d::Zero();
  if (observations.planes.empty()) return covariance;
  const StepMoments moments = MomentsOf(observations, before, state);
  if (!(moments.square_radius > 0.0)) return covariance;
  const Eigen::Vector3d& center = moments.center;
  Eigen::Matrix3d cross;
  cross << 0, -center.z(), center.y(), center.z(), 0, -center.x(), -center.y(), center.x(), 0;
  Matrix6d jacobian = Matrix6d::Identity();
  const Eigen::Matrix3d map_from_camera =
      state.camera_from_map.rotation.conjugate().toRotationMatrix();
  jacobian.topLeftCorner<3, 3>() = map_from_camera;
  jacobian.topRightCorner<3, 3>() = map_from_camera * cross;
  const double place = kCommonPlaceScale * kCommonPlaceScale * moments.square_step;
  const double turn = kCommonTurnScale * kCommonTurnScale * moments.square_step;
  covariance.diagonal().head<3>().setConstant(place);
  covariance.diagonal().tail<3>().setConstant(turn / moments.square_radius);
  return jacobian * covariance * jacobian.transpose();
}

}  // namespace ceres_ed
