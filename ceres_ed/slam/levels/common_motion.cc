#include "ceres_ed/slam/levels/common_motion.h"

#include <algorithm>
#include <cstddef>

#include <cost_functions/node_parameters.h>

namespace ceres_ed {

Eigen::Matrix<double, 6, 6> CommonMotionCovariance(const FrameObservations& observations,
                                                   const std::vector<Eigen::Vector3d>& nodes_before,
                                                   const DeformableMap& map) {
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  if (observations.planes.empty()) return covariance;
  const auto count = static_cast<double>(observations.planes.size());
  double square_step = 0.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const MapObservation& o : observations.planes) {
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    for (int i = 0; i < o.binding.size; ++i) {
      const int node = o.binding.nodes[i];
      if (static_cast<std::size_t>(node) >= nodes_before.size()) continue;
      step += o.binding.weights[i] * (NodeTranslation(map.state().node(node)) - nodes_before[node]);
    }
    square_step += step.squaredNorm() / count;
    center += o.target / count;
  }
  double square_radius = 0.0;
  for (const MapObservation& o : observations.planes) {
    square_radius += (o.target - center).squaredNorm() / count;
  }
  if (!(square_radius > 0.0)) return covariance;
  Eigen::Matrix3d cross;
  cross << 0, -center.z(), center.y(), center.z(), 0, -center.x(), -center.y(), center.x(), 0;
  Eigen::Matrix<double, 6, 6> jacobian = Eigen::Matrix<double, 6, 6>::Identity();
  const Eigen::Matrix3d map_from_camera =
      map.state().camera_from_map.rotation.conjugate().toRotationMatrix();
  jacobian.topLeftCorner<3, 3>() = map_from_camera;
  jacobian.topRightCorner<3, 3>() = map_from_camera * cross;
  const double square = kCommonMotionScale * kCommonMotionScale * square_step;
  covariance.diagonal().head<3>().setConstant(square);
  covariance.diagonal().tail<3>().setConstant(square / square_radius);
  return jacobian * covariance * jacobian.transpose();
}

}  // namespace ceres_ed
