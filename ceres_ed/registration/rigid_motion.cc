#include "ceres_ed/registration/rigid_motion.h"

#include <Eigen/Core>
#include <Eigen/SVD>

namespace ceres_ed {

DeformationState RigidMotion(const UnitFit& fit,
                             const BuiltGraph& graph,
                             const std::vector<Correspondence>& matches) {
  double weight = 0.0;
  Eigen::Vector3d from_mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_mean = Eigen::Vector3d::Zero();
  for (const Correspondence& match : matches) {
    weight += match.weight;
    from_mean += match.weight * fit.source->cloud().points[match.point];
    to_mean += match.weight * match.target;
  }
  from_mean /= weight;
  to_mean /= weight;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Correspondence& match : matches) {
    const Eigen::Vector3d from = fit.source->cloud().points[match.point] - from_mean;
    covariance += match.weight * (match.target - to_mean) * from.transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if (U.determinant() * svd.matrixV().determinant() < 0.0) U.col(2) *= -1.0;
  const Eigen::Matrix3d R = U * svd.matrixV().transpose();
  DeformationState state(graph.graph.num_nodes());
  for (int j = 0; j < state.num_nodes(); ++j) {
    const Eigen::Vector3d& node = graph.graph.position(j);
    MutableNodeAffine(state.node(j)) = R;
    MutableNodeTranslation(state.node(j)) = to_mean + R * (node - from_mean) - node;
  }
  return state;
}

}  // namespace ceres_ed
