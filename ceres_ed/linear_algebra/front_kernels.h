// Dense kernels for the frontal matrices of a sparse Cholesky factorisation.
//
// All matrices are column-major. Their rows are padded to a multiple of kRowUnit, so that no kernel
// has to treat a remainder. One library contains the kernels compiled for AVX-512, for AVX2 and for
// plain x86-64, and the processor at run time decides which of them are used.
#ifndef CERES_ED_LINEAR_ALGEBRA_FRONT_KERNELS_H_
#define CERES_ED_LINEAR_ALGEBRA_FRONT_KERNELS_H_

#include <cstddef>

namespace ceres_ed {

// The number of rows and the leading dimension of a front are multiples of this.
inline constexpr int kRowUnit = 8;
// The number of columns that are factorised at a time.
inline constexpr int kPanelWidth = 24;

// Returns `rows` rounded up to a multiple of kRowUnit.
inline constexpr int RoundUpRows(int rows) { return (rows + kRowUnit - 1) / kRowUnit * kRowUnit; }

// A lower triangle in strips of kRowUnit columns: each strip has the rows from its first column to
// the end, `rows` of which there are, a multiple of kRowUnit. This is little more than half of the
// square. Returns where entry (0, column) would be, to which its row is added.
inline constexpr std::ptrdiff_t StripOffset(int rows, int column) {
  const std::ptrdiff_t first = column / kRowUnit * kRowUnit;
  const std::ptrdiff_t before = first * rows - first * (first - kRowUnit) / 2;
  return before + (column - first) * (rows - first) - first;
}

// Returns the number of values of such a triangle.
inline constexpr std::size_t StripsSize(int rows) {
  return static_cast<std::size_t>(StripOffset(rows, rows) + rows);
}

// Returns what the kernels of this process are compiled for: "AVX-512", "AVX2" or "plain".
const char* FrontKernelName();

// Factorises the first `width` columns of a front in place: replaces [F11; F21] by [L11; L21],
// where only the lower triangle of F11 is read. Rows [width, RoundUpRows(width)) are zero, and F21
// starts after them. The panel has `rows` rows in all, a multiple of kRowUnit, and a column stride
// of `stride` >= rows. Values above the diagonal are overwritten. Returns false if F11 is not
// positive definite.
bool FactorizePanel(int width, int rows, int stride, double* panel);

// The operation update = [update] + sign L21 L21^T on the lower triangle (values above the diagonal
// are overwritten). L21 has `rows` rows, a multiple of kRowUnit, and `width` columns.
struct OuterProduct {
  int width = 0;
  int rows = 0;
  const double* L21 = nullptr;
  int stride = 0;
  double sign = -1.0;
  // Whether the product is added to `update` (true) or overwrites it (false).
  bool accumulate = false;
  double* update = nullptr;
  // The column stride of `update`, or 0 if it has strips (StripOffset()).
  int update_stride = 0;

  // Returns the address of entry (0, column) of the update, and the stride there.
  double* UpdateColumn(int column) const {
    return update + (update_stride > 0 ? static_cast<std::ptrdiff_t>(column) * update_stride
                                       : StripOffset(rows, column));
  }
  int StrideAt(int column) const {
    return update_stride > 0 ? update_stride : rows - column / kRowUnit * kRowUnit;
  }
};

// Computes columns [first, last) of the product. `first` is a multiple of kRowUnit.
void AddOuterProduct(const OuterProduct& product, int first, int last);

// Computes x -= L y for a panel of `rows` rows, a multiple of kRowUnit, and `width` columns.
void SubtractProduct(int width, int rows, const double* L, int stride, const double* y, double* x);

// Computes y -= L^T x for the same kind of panel.
void SubtractTransposedProduct(
    int width, int rows, const double* L, int stride, const double* x, double* y);

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_FRONT_KERNELS_H_
