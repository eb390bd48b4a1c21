// Block matrices as dense ones, to compare with.
#ifndef CERES_ED_TEST_LINEAR_ALGEBRA_DENSE_MATRIX_H_
#define CERES_ED_TEST_LINEAR_ALGEBRA_DENSE_MATRIX_H_

#include <ceres_ed/linear_algebra/block_structure.h>

#include <vector>

#include <Eigen/Core>
#include <ceres/crs_matrix.h>

namespace ceres_ed {

// The lower triangle in blocks as a full symmetric matrix.
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

// A Jacobian of Ceres as a dense matrix.
inline Eigen::MatrixXd DenseOf(const ceres::CRSMatrix& crs) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(crs.num_rows, crs.num_cols);
  for (int r = 0; r < crs.num_rows; ++r) {
    for (int k = crs.rows[r]; k < crs.rows[r + 1]; ++k) dense(r, crs.cols[k]) = crs.values[k];
  }
  return dense;
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_LINEAR_ALGEBRA_DENSE_MATRIX_H_
