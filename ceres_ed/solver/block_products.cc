#include "ceres_ed/solver/block_products.h"

#include <cost_functions/node_parameters.h>

// Compiled for plain x86-64 and for AVX2; the loader takes what the machine has. Sanitizers can't
// follow the indirection.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CERES_ED_FOR_EACH_MACHINE __attribute__((target_clones("arch=haswell", "default")))
#else
#define CERES_ED_FOR_EACH_MACHINE
#endif

namespace ceres_ed {
namespace {

CERES_ED_FOR_EACH_MACHINE
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

// Columns 3 j + c of the product are b_j times column c of a (x) M.
CERES_ED_FOR_EACH_MACHINE
void AddKroneckerProduct(
    double scale, const double* a, const double* b, const double* M, double* out) {
  double kronecker[3][kNodeSize];
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < 4; ++i) {
      for (int r = 0; r < 3; ++r) kronecker[c][3 * i + r] = a[i] * M[3 * c + r];
    }
  }
  for (int j = 0; j < 4; ++j) {
    const double factor = scale * b[j];
    for (int c = 0; c < 3; ++c) {
      double* column = out + (3 * j + c) * kNodeSize;
      for (int r = 0; r < kNodeSize; ++r) column[r] += factor * kronecker[c][r];
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

void AddPointProduct(
    double scale, const double* a, const double* b, const Eigen::Matrix3d& M, double* out) {
  AddKroneckerProduct(scale, a, b, M.data(), out);
}

}  // namespace ceres_ed
