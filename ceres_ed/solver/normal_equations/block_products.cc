#include "ceres_ed/solver/normal_equations/block_products.h"

#include <ceres_ed/util/for_each_machine.h>

#include <cost_functions/node_parameters.h>

namespace ceres_ed {
namespace {

CERES_ED_FOR_EACH_MACHINE_WITH_AVX512
void AddNodeProduct(int num_residuals, const double* A, const double* B, int stride, double* out) {
  for (int k = 0; k < num_residuals; ++k) {
    const double* a = A + k * kNodeSize;
    const double* b = B + k * kNodeSize;
    for (int c = 0; c < kNodeSize; ++c) {
      double* column = out + c * stride;
      for (int r = 0; r < kNodeSize; ++r) column[r] += a[r] * b[c];
    }
  }
}

}  // namespace

void AddJacobianProduct(int num_residuals,
                        const double* A,
                        int rows,
                        const double* B,
                        int columns,
                        int stride,
                        double* out) {
  if (rows == kNodeSize && columns == kNodeSize) {
    AddNodeProduct(num_residuals, A, B, stride, out);
    return;
  }
  for (int k = 0; k < num_residuals; ++k) {
    for (int c = 0; c < columns; ++c) {
      for (int r = 0; r < rows; ++r) out[c * stride + r] += A[k * rows + r] * B[k * columns + c];
    }
  }
}

}  // namespace ceres_ed
