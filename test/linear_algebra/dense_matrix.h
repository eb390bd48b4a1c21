// Makes block matrices with random values, and dense matrices to compare them with.
#ifndef CERES_ED_TEST_LINEAR_ALGEBRA_DENSE_MATRIX_H_
#define CERES_ED_TEST_LINEAR_ALGEBRA_DENSE_MATRIX_H_

#include <ceres_ed/linear_algebra/block_structure.h>

#include <algorithm>
#include <random>
#include <vector>

#include <Eigen/Core>
#include <ceres/crs_matrix.h>

namespace ceres_ed {

// Returns random values for the blocks; they are zero where affine parts are not coupled.
inline std::vector<double> RandomValues(const BlockStructure& structure, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> values(structure.num_values());
  for (double& value : values) value = uniform(random);
  for (int e = 0; e < structure.num_entries(); ++e) {
    if (structure.head_pair(e)) continue;
    double* block = &values[structure.value_offset(e)];
    for (int c = 0; c < 9; ++c) std::fill_n(block + 12 * c, 9, 0.0);
  }
  return values;
}

// Returns the lower triangle in blocks as a full symmetric matrix.
inline Eigen::MatrixXd DenseOf(const BlockStructure& structure, const std::vector<double>& values) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(structure.num_rows(), structure.num_rows());
  for (int j = 0; j < structure.num_blocks(); ++j) {
    for (int e = structure.column_begin(j); e < structure.column_begin(j + 1); ++e) {
      const int i = structure.entry_row(e);
      dense.block(
          structure.row_offset(i), structure.row_offset(j), structure.size(i), structure.size(j)) =
          Eigen::Map<const Eigen::MatrixXd>(
              &values[structure.value_offset(e)], structure.size(i), structure.size(j));
    }
  }
  return dense.selfadjointView<Eigen::Lower>();
}

// Returns a Jacobian of Ceres as a dense matrix.
inline Eigen::MatrixXd DenseOf(const ceres::CRSMatrix& crs) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(crs.num_rows, crs.num_cols);
  for (int r = 0; r < crs.num_rows; ++r) {
    for (int k = crs.rows[r]; k < crs.rows[r + 1]; ++k) dense(r, crs.cols[k]) = crs.values[k];
  }
  return dense;
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_LINEAR_ALGEBRA_DENSE_MATRIX_H_
