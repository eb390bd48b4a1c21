#include "ceres_ed/geometry/similarity.h"

#include <string>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

// If the spread of the points across their main axis is below this fraction of the spread along it,
// the points lie on a line.
constexpr double kMinRelativeSpread = 1e-12;

}  // namespace

Similarity Similarity::operator*(const Similarity& other) const {
  Similarity result;
  result.scale = scale * other.scale;
  result.rotation = (rotation * other.rotation).normalized();
  result.translation = (*this) * other.translation;
  return result;
}

Similarity Similarity::Inverse() const {
  CHECK(scale != 0.0) << "a similarity of scale 0 has no inverse";
  Similarity result;
  result.scale = 1.0 / scale;
  result.rotation = rotation.conjugate();
  result.translation = -(result.scale * (result.rotation * translation));
  return result;
}

StatusOr<Similarity> Similarity::FitPoints(const std::vector<Eigen::Vector3d>& from,
                                           const std::vector<Eigen::Vector3d>& to,
                                           bool with_scale) {
  CHECK_EQ(from.size(), to.size());
  if (from.size() < 3) {
    return Status::Error("a rigid fit needs at least 3 point pairs, but there are " +
                         std::to_string(from.size()));
  }
  const double num_pairs = static_cast<double>(from.size());
  Eigen::Vector3d from_mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    from_mean += from[i] / num_pairs;
    to_mean += to[i] / num_pairs;
  }
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double from_variance = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    covariance += (to[i] - to_mean) * (from[i] - from_mean).transpose() / num_pairs;
    from_variance += (from[i] - from_mean).squaredNorm() / num_pairs;
  }
  if (!covariance.allFinite()) return Status::Error("a rigid fit needs finite points");
  // With covariance = U Sigma V^T, the best rotation is U V^T (Umeyama 1991).
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& sigma = svd.singularValues();
  if (!(sigma[1] > kMinRelativeSpread * sigma[0])) {
    return Status::Error(
        "a rigid fit needs points that do not lie on one line: these leave the rotation open");
  }
  // The sign makes the rotation proper if the pairs fit a reflection better.
  Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) sign[2] = -1.0;
  const Eigen::Matrix3d R = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  Similarity result;
  result.rotation = Eigen::Quaterniond(R).normalized();
  result.scale = with_scale ? sigma.dot(sign) / from_variance : 1.0;
  result.translation = to_mean - result.scale * (result.rotation * from_mean);
  return result;
}

}  // namespace ceres_ed
