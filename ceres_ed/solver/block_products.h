// The inner loops of assembling normal equations.
#ifndef CERES_ED_SOLVER_BLOCK_PRODUCTS_H_
#define CERES_ED_SOLVER_BLOCK_PRODUCTS_H_

#include <Eigen/Core>

namespace ceres_ed {

// out += A^T B for row-major A (num_residuals x rows) and B (num_residuals x columns); `out` is
// column-major with `stride` values a column.
void AddJacobianProduct(int num_residuals,
                        const double* A,
                        int rows,
                        const double* B,
                        int columns,
                        int stride,
                        double* out);

// out += scale (a b^T) (x) M for 4-vectors a, b and a symmetric M: the product of the Jacobians of
// two nodes, weight * [offset; 1]^T (x) D, with M = D^T D. `out` is a column-major 12 x 12 block.
void AddPointProduct(
    double scale, const double* a, const double* b, const Eigen::Matrix3d& M, double* out);

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_BLOCK_PRODUCTS_H_
