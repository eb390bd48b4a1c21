#include "ceres_ed/registration/rigid/rigid_starts.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

Eigen::Vector3d Centroid(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

Eigen::Matrix3d PrincipalAxes(const std::vector<Eigen::Vector3d>& points) {
  const Eigen::Vector3d center = Centroid(points);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    covariance += (point - center) * (point - center).transpose();
  }
  Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
  if (axes.determinant() < 0.0) axes.col(0) *= -1.0;
  return axes;
}

// Returns the pose that rotates the source by R and maps its centroid to that of the target.
Similarity CenteredPose(const Eigen::Matrix3d& R,
                        double scale,
                        const Eigen::Vector3d& from,
                        const Eigen::Vector3d& to) {
  Similarity pose;
  pose.scale = scale;
  pose.rotation = Eigen::Quaterniond(R);
  pose.translation = to - scale * (R * from);
  return pose;
}

}  // namespace

std::vector<Similarity> RigidStarts(const std::vector<Eigen::Vector3d>& source,
                                    const std::vector<Eigen::Vector3d>& target,
                                    const Similarity& initial) {
  const Eigen::Vector3d from = Centroid(source);
  const Eigen::Vector3d to = Centroid(target);
  const Eigen::Matrix3d R_initial = initial.rotation.toRotationMatrix();
  std::vector<Similarity> starts = {CenteredPose(R_initial, initial.scale, from, to)};
  const Eigen::Matrix3d source_axes = PrincipalAxes(source);
  const Eigen::Matrix3d target_axes = PrincipalAxes(target);
  for (const Eigen::Vector3d& signs : {Eigen::Vector3d(1, 1, 1),
                                       Eigen::Vector3d(1, -1, -1),
                                       Eigen::Vector3d(-1, 1, -1),
                                       Eigen::Vector3d(-1, -1, 1)}) {
    const Eigen::Matrix3d R = target_axes * signs.asDiagonal() * source_axes.transpose();
    starts.push_back(CenteredPose(R, initial.scale, from, to));
  }
  return starts;
}

}  // namespace ceres_ed
