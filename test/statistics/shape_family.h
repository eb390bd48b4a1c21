// Populations of shapes whose statistics are known.
#ifndef CERES_ED_TEST_STATISTICS_SHAPE_FAMILY_H_
#define CERES_ED_TEST_STATISTICS_SHAPE_FAMILY_H_

#include <ceres_ed/statistics/shape_table.h>
#include <ceres_ed/util/random.h>

#include <cmath>
#include <vector>

#include <Eigen/Dense>

namespace ceres_ed {

// Returns `count` random orthonormal columns of length `size`.
inline Eigen::MatrixXd RandomModes(int size, int count, std::uint64_t seed) {
  Random random(seed);
  Eigen::MatrixXd columns(size, count);
  for (Eigen::Index i = 0; i < columns.size(); ++i) columns.data()[i] = random.Gaussian();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  return qr.householderQ() * Eigen::MatrixXd::Identity(size, count);
}

// Returns scores (N x K) whose columns have mean 0, are orthogonal, and have exactly these sample
// variances (by N - 1).
inline Eigen::MatrixXd ExactScores(int shapes, const std::vector<double>& variances) {
  const auto count = static_cast<int>(variances.size());
  Eigen::MatrixXd columns(shapes, count + 1);
  columns.col(0).setOnes();
  columns.rightCols(count) = RandomModes(shapes, count, 7);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  Eigen::MatrixXd scores =
      (qr.householderQ() * Eigen::MatrixXd::Identity(shapes, count + 1)).rightCols(count);
  for (int k = 0; k < count; ++k) scores.col(k) *= std::sqrt(variances[k] * (shapes - 1));
  return scores;
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_STATISTICS_SHAPE_FAMILY_H_
