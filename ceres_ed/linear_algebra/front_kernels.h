// Dense kernels of the frontal matrices of a sparse Cholesky factorisation.
//
// Matrices are column-major; rows are padded to kRowUnit, so that no kernel has a rest to deal
// with. Compiled for AVX-512, AVX2 and plain x86-64 in one library; the machine at hand decides.
#ifndef CERES_ED_LINEAR_ALGEBRA_FRONT_KERNELS_H_
#define CERES_ED_LINEAR_ALGEBRA_FRONT_KERNELS_H_

namespace ceres_ed {

// Rows and leading dimensions of fronts are multiples of this.
inline constexpr int kRowUnit = 8;
// Columns that are factorised at a time.
inline constexpr int kPanelWidth = 24;

inline constexpr int RoundUpRows(int rows) { return (rows + kRowUnit - 1) / kRowUnit * kRowUnit; }

// What the kernels of this process are compiled for: "AVX-512", "AVX2" or "plain".
const char* FrontKernelName();

// Factorises the first `width` columns of a front in place: [L11; L21] for [F11; F21], lower
// triangle of F11 alone. Rows [width, RoundUpRows(width)) are zero; F21 starts behind them.
// `rows` in all, a multiple of kRowUnit; `stride` >= rows a column. What stands above the diagonal
// is overwritten. False when F11 isn't positive definite.
bool FactorizePanel(int width, int rows, int stride, double* panel);

// update = [update] + sign L21 L21^T, lower triangle (what stands above the diagonal is
// overwritten). L21 has `rows` rows, a multiple of kRowUnit, and `width` columns.
struct OuterProduct {
  int width = 0;
  int rows = 0;
  const double* L21 = nullptr;
  int stride = 0;
  double sign = -1.0;
  // Whether `update` is added to, or overwritten.
  bool accumulate = false;
  double* update = nullptr;
  int update_stride = 0;
};

// Columns [first, last) of a product; `first` is a multiple of kRowUnit.
void AddOuterProduct(const OuterProduct& product, int first, int last);

// x -= L y for a panel of `rows` rows, a multiple of kRowUnit, and `width` columns.
void SubtractProduct(int width, int rows, const double* L, int stride, const double* y, double* x);

// y -= L^T x.
void SubtractTransposedProduct(
    int width, int rows, const double* L, int stride, const double* x, double* y);

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_FRONT_KERNELS_H_
