// The inner loops of the assembly of normal equations.
#ifndef CERES_ED_SOLVER_NORMAL_EQUATIONS_BLOCK_PRODUCTS_H_
#define CERES_ED_SOLVER_NORMAL_EQUATIONS_BLOCK_PRODUCTS_H_

namespace ceres_ed {

// Computes out += A^T B for row-major A (num_residuals x rows) and B (num_residuals x columns).
// `out` is column-major with a column stride of `stride` values.
void AddJacobianProduct(int num_residuals,
                        const double* A,
                        int rows,
                        const double* B,
                        int columns,
                        int stride,
                        double* out);

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_NORMAL_EQUATIONS_BLOCK_PRODUCTS_H_
