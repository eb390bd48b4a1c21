#include "ceres_ed/registration/normal_spread.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace ceres_ed {

double LeastNormalSpread(const Surface& surface) {
  const std::vector<Eigen::Vector3d>& normals = surface.cloud().normals;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double area = 0.0;
  for (std::size_t p = 0; p < normals.size(); ++p) {
    const double weight = surface.relative_areas()[p] * normals[p].squaredNorm();
    sum += surface.relative_areas()[p] * normals[p] * normals[p].transpose();
    area += weight;
  }
  if (!(area > 0.0)) return 0.0;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(sum / area, Eigen::EigenvaluesOnly);
  return std::max(0.0, eigen.eigenvalues()[0]);
}

}  // namespace ceres_ed
