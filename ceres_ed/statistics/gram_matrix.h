// Inner products of the shapes of a population, from which all that is linear follows.
#ifndef CERES_ED_STATISTICS_GRAM_MATRIX_H_
#define CERES_ED_STATISTICS_GRAM_MATRIX_H_

#include <ceres_ed/statistics/shape_table.h>
#include <ceres_ed/util/status.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns G_ij = (x_i - c) . (x_j - c) for the rows `shapes` of the table (all of them if it is
// empty), with c = `centre` (3 V numbers).
StatusOr<Eigen::MatrixXd> GramMatrix(const ShapeTable& table,
                                     const Eigen::VectorXd& centre,
                                     const std::vector<int>& shapes = {});

// Returns the Gram matrix of the same shapes about their own mean: H G H with H = I - 1/n.
Eigen::MatrixXd CentredGram(const Eigen::MatrixXd& gram);

// Eigenvalues in descending order with their eigenvectors; those below 1e-12 of the trace are left
// out.
struct GramModes {
  Eigen::VectorXd values;
  // n x (number of values); columns have unit length.
  Eigen::MatrixXd vectors;
};

GramModes DecomposeGram(const Eigen::MatrixXd& centred_gram);

}  // namespace ceres_ed

#endif  // CERES_ED_STATISTICS_GRAM_MATRIX_H_
