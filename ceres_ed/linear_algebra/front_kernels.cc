#include "ceres_ed/linear_algebra/front_kernels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#if defined(__x86_64__) && defined(__GNUC__)
#define CERES_ED_HAVE_X86_TARGETS
#endif

namespace ceres_ed {
namespace {

// A SIMD vector of kLanes doubles.
template <int kLanes>
struct Vector {
  typedef double Type __attribute__((vector_size(kLanes * sizeof(double)), may_alias));
  // The same at the address of any double. It is a packed struct, because clang forgets the
  // alignment that is given to the type itself, and then moves it with instructions that fault.
  struct __attribute__((packed, may_alias)) Anywhere {
    Type value;
  };
};

#define CERES_ED_INLINE [[gnu::always_inline]] inline

template <int kLanes>
CERES_ED_INLINE typename Vector<kLanes>::Anywhere& At(double* address) {
  return *reinterpret_cast<typename Vector<kLanes>::Anywhere*>(address);
}

template <int kLanes>
CERES_ED_INLINE const typename Vector<kLanes>::Anywhere& At(const double* address) {
  return *reinterpret_cast<const typename Vector<kLanes>::Anywhere*>(address);
}

// Computes C = [C] + sign A B^T for a tile C of kVectors * kLanes rows and `columns` <= kColumns
// columns. A and B have `depth` columns and share a stride. All kColumns rows of B are read.
template <int kLanes, int kVectors, int kColumns, bool kOverwrite>
CERES_ED_INLINE void MultiplyTile(int depth,
                                  const double* A,
                                  const double* B,
                                  int stride,
                                  int columns,
                                  double sign,
                                  double* C,
                                  int C_stride) {
  typename Vector<kLanes>::Type sums[kColumns][kVectors] = {};
  for (int p = 0; p < depth; ++p) {
    const double* a = A + static_cast<std::ptrdiff_t>(p) * stride;
    const double* b = B + static_cast<std::ptrdiff_t>(p) * stride;
#pragma GCC unroll 8
    for (int c = 0; c < kColumns; ++c) {
#pragma GCC unroll 4
      for (int v = 0; v < kVectors; ++v) sums[c][v] += At<kLanes>(a + v * kLanes).value * b[c];
    }
  }
#pragma GCC unroll 8
  for (int c = 0; c < kColumns; ++c) {
    if (c >= columns) break;
    double* out = C + static_cast<std::ptrdiff_t>(c) * C_stride;
#pragma GCC unroll 4
    for (int v = 0; v < kVectors; ++v) {
      if (kOverwrite) {
        At<kLanes>(out + v * kLanes).value = sign * sums[c][v];
      } else {
        At<kLanes>(out + v * kLanes).value += sign * sums[c][v];
      }
    }
  }
}

// Does the same for any number of rows that is a multiple of kRowUnit, and for `columns` <=
// kRowUnit. It has the nine arguments that a product of matrices has in BLAS.
template <int kLanes, int kVectors, int kColumns, bool kOverwrite>
// NOLINTNEXTLINE(readability-function-size)
CERES_ED_INLINE void MultiplyStrip(int rows,
                                   int depth,
                                   const double* A,
                                   const double* B,
                                   int stride,
                                   int columns,
                                   double sign,
                                   double* C,
                                   int C_stride) {
  for (int c = 0; c < columns; c += kColumns) {
    double* out = C + static_cast<std::ptrdiff_t>(c) * C_stride;
    const int width = std::min(kColumns, columns - c);
    int row = 0;
    for (; row + kVectors * kLanes <= rows; row += kVectors * kLanes) {
      MultiplyTile<kLanes, kVectors, kColumns, kOverwrite>(
          depth, A + row, B + c, stride, width, sign, out + row, C_stride);
    }
    for (; row < rows; row += kLanes) {
      MultiplyTile<kLanes, 1, kColumns, kOverwrite>(
          depth, A + row, B + c, stride, width, sign, out + row, C_stride);
    }
  }
}

// Computes the Cholesky factor of the lower triangle of a `width` x `width` block, and writes the
// inverse of its diagonal to `inverse`.
CERES_ED_INLINE bool FactorizeDiagonal(int width, int stride, double* block, double* inverse) {
  for (int c = 0; c < width; ++c) {
    double* column = block + static_cast<std::ptrdiff_t>(c) * stride;
    const double pivot = column[c];
    if (!(pivot > 0.0) || !std::isfinite(pivot)) return false;
    const double root = std::sqrt(pivot);
    inverse[c] = 1.0 / root;
    column[c] = root;
    for (int r = c + 1; r < width; ++r) column[r] *= inverse[c];
    for (int j = c + 1; j < width; ++j) {
      double* other = block + static_cast<std::ptrdiff_t>(j) * stride;
      const double factor = column[j];
      for (int r = j; r < width; ++r) other[r] -= factor * column[r];
    }
  }
  return true;
}

// Computes rows <- rows L^-T for kVectors * kLanes rows of `width` columns, with the triangle L at
// `block`.
template <int kLanes, int kVectors>
CERES_ED_INLINE void SolveTile(
    int width, int stride, const double* block, const double* inverse, double* rows) {
  using V = typename Vector<kLanes>::Type;
  for (int c = 0; c < width; ++c) {
    double* out = rows + static_cast<std::ptrdiff_t>(c) * stride;
    V x[kVectors];
#pragma GCC unroll 4
    for (int v = 0; v < kVectors; ++v) x[v] = At<kLanes>(out + v * kLanes).value;
    for (int p = 0; p < c; ++p) {
      const double factor = block[static_cast<std::ptrdiff_t>(p) * stride + c];
      const double* before = rows + static_cast<std::ptrdiff_t>(p) * stride;
#pragma GCC unroll 4
      for (int v = 0; v < kVectors; ++v) x[v] -= At<kLanes>(before + v * kLanes).value * factor;
    }
#pragma GCC unroll 4
    for (int v = 0; v < kVectors; ++v) At<kLanes>(out + v * kLanes).value = x[v] * inverse[c];
  }
}

template <int kLanes, int kVectors, int kColumns>
// The blocked factorisation behind FactorizePanel(), in blocks of kPanelWidth columns.
CERES_ED_INLINE bool Panel(int width, int rows, int stride, double* panel) {
  double inverse[kPanelWidth];
  for (int first = 0; first < width; first += kPanelWidth) {
    const int block_width = std::min(kPanelWidth, width - first);
    double* block = panel + static_cast<std::ptrdiff_t>(first) * stride + first;
    if (first > 0) {
      // Subtracts the contribution of the columns before this block.
      for (int c = 0; c < block_width; c += kRowUnit) {
        MultiplyStrip<kLanes, kVectors, kColumns, false>(
            rows - first - c,
            first,
            panel + first + c,
            panel + first + c,
            stride,
            std::min(kRowUnit, block_width - c),
            -1.0,
            block + static_cast<std::ptrdiff_t>(c) * stride + c,
            stride);
      }
    }
    if (!FactorizeDiagonal(block_width, stride, block, inverse)) return false;
    // Solves for the rows from the next unit on. The rows before it that share the last unit of
    // this block are zero or belong to the block.
    int row = RoundUpRows(block_width);
    const int end = rows - first;
    for (; row + kVectors * kLanes <= end; row += kVectors * kLanes) {
      SolveTile<kLanes, kVectors>(block_width, stride, block, inverse, block + row);
    }
    for (; row < end; row += kLanes) {
      SolveTile<kLanes, 1>(block_width, stride, block, inverse, block + row);
    }
  }
  return true;
}

// The number of rows that stay in the second-level cache while all columns are multiplied with
// them.
constexpr int kRowBlock = 192;

template <int kLanes, int kVectors, int kColumns, bool kOverwrite>
CERES_ED_INLINE void AddColumns(const OuterProduct& product, int first, int last) {
  for (int first_row = first; first_row < product.rows; first_row += kRowBlock) {
    const int last_row = std::min(product.rows, first_row + kRowBlock);
    for (int c = first; c < std::min(last_row, last); c += kRowUnit) {
      const int row = std::max(c, first_row);
      MultiplyStrip<kLanes, kVectors, kColumns, kOverwrite>(last_row - row,
                                                            product.width,
                                                            product.L21 + row,
                                                            product.L21 + c,
                                                            product.stride,
                                                            std::min(kRowUnit, last - c),
                                                            product.sign,
                                                            product.UpdateColumn(c) + row,
                                                            product.StrideAt(c));
    }
  }
}

// The number of columns of a panel that are processed together, so that the vector is loaded once
// for all of them.
constexpr int kColumnGroup = 4;

template <int kLanes, int kColumns>
CERES_ED_INLINE void ProductOfColumns(
    int rows, const double* L, int stride, const double* y, double* x) {
  for (int row = 0; row < rows; row += kLanes) {
    typename Vector<kLanes>::Type sum = At<kLanes>(x + row).value;
#pragma GCC unroll 4
    for (int c = 0; c < kColumns; ++c) sum -= At<kLanes>(L + c * stride + row).value * y[c];
    At<kLanes>(x + row).value = sum;
  }
}

template <int kLanes>
CERES_ED_INLINE void Product(
    int width, int rows, const double* L, int stride, const double* y, double* x) {
  int c = 0;
  for (; c + kColumnGroup <= width; c += kColumnGroup) {
    ProductOfColumns<kLanes, kColumnGroup>(
        rows, L + static_cast<std::ptrdiff_t>(c) * stride, stride, y + c, x);
  }
  for (; c < width; ++c) {
    ProductOfColumns<kLanes, 1>(
        rows, L + static_cast<std::ptrdiff_t>(c) * stride, stride, y + c, x);
  }
}

template <int kLanes, int kColumns>
CERES_ED_INLINE void TransposedProductOfColumns(
    int rows, const double* L, int stride, const double* x, double* y) {
  typename Vector<kLanes>::Type sums[kColumns] = {};
  for (int row = 0; row < rows; row += kLanes) {
    const typename Vector<kLanes>::Type factor = At<kLanes>(x + row).value;
#pragma GCC unroll 4
    for (int c = 0; c < kColumns; ++c) sums[c] += At<kLanes>(L + c * stride + row).value * factor;
  }
  for (int c = 0; c < kColumns; ++c) {
    for (int i = 0; i < kLanes; ++i) y[c] -= sums[c][i];
  }
}

template <int kLanes>
CERES_ED_INLINE void TransposedProduct(
    int width, int rows, const double* L, int stride, const double* x, double* y) {
  int c = 0;
  for (; c + kColumnGroup <= width; c += kColumnGroup) {
    TransposedProductOfColumns<kLanes, kColumnGroup>(
        rows, L + static_cast<std::ptrdiff_t>(c) * stride, stride, x, y + c);
  }
  for (; c < width; ++c) {
    TransposedProductOfColumns<kLanes, 1>(
        rows, L + static_cast<std::ptrdiff_t>(c) * stride, stride, x, y + c);
  }
}

// The kernels for one kind of processor.
struct Kernels {
  const char* name;
  bool (*factorize_panel)(int, int, int, double*);
  void (*outer_product)(const OuterProduct&, int, int);
  void (*product)(int, int, const double*, int, const double*, double*);
  void (*transposed_product)(int, int, const double*, int, const double*, double*);
};

// Defines kernels with `LANES` doubles per SIMD vector and tiles of `VECTORS` by `COLUMNS`, which
// fill the registers of that processor.
// NOLINTBEGIN(bugprone-macro-parentheses): NAME is part of names, and TARGET an attribute.
#define CERES_ED_DEFINE_KERNELS(NAME, TEXT, TARGET, LANES, VECTORS, COLUMNS)          \
  TARGET bool NAME##Panel(int width, int rows, int stride, double* panel) {           \
    return Panel<LANES, VECTORS, COLUMNS>(width, rows, stride, panel);                \
  }                                                                                   \
  TARGET void NAME##OuterProduct(const OuterProduct& product, int first, int last) {  \
    if (product.accumulate) {                                                         \
      AddColumns<LANES, VECTORS, COLUMNS, false>(product, first, last);               \
    } else {                                                                          \
      AddColumns<LANES, VECTORS, COLUMNS, true>(product, first, last);                \
    }                                                                                 \
  }                                                                                   \
  TARGET void NAME##Product(                                                          \
      int width, int rows, const double* L, int stride, const double* y, double* x) { \
    Product<LANES>(width, rows, L, stride, y, x);                                     \
  }                                                                                   \
  TARGET void NAME##TransposedProduct(                                                \
      int width, int rows, const double* L, int stride, const double* x, double* y) { \
    TransposedProduct<LANES>(width, rows, L, stride, x, y);                           \
  }                                                                                   \
  constexpr Kernels k##NAME = {                                                       \
      TEXT, NAME##Panel, NAME##OuterProduct, NAME##Product, NAME##TransposedProduct};
// NOLINTEND(bugprone-macro-parentheses)

CERES_ED_DEFINE_KERNELS(Plain, "plain", , 2, 2, 4)
#ifdef CERES_ED_HAVE_X86_TARGETS
CERES_ED_DEFINE_KERNELS(Avx2, "AVX2", [[gnu::target("avx2,fma")]], 4, 3, 4)
CERES_ED_DEFINE_KERNELS(
    Avx512, "AVX-512", [[gnu::target("avx512f,avx512vl,avx512dq,avx2,fma")]], 8, 3, 8)
#endif

Kernels ChooseKernels() {
#ifdef CERES_ED_HAVE_X86_TARGETS
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq")) {
    return kAvx512;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return kAvx2;
#endif
  return kPlain;
}

const Kernels& ForThisMachine() {
  static const Kernels kernels = ChooseKernels();
  return kernels;
}

}  // namespace

const char* FrontKernelName() { return ForThisMachine().name; }

bool FactorizePanel(int width, int rows, int stride, double* panel) {
  return ForThisMachine().factorize_panel(width, rows, stride, panel);
}

void AddOuterProduct(const OuterProduct& product, int first, int last) {
  ForThisMachine().outer_product(product, first, last);
}

void SubtractProduct(int width, int rows, const double* L, int stride, const double* y, double* x) {
  ForThisMachine().product(width, rows, L, stride, y, x);
}

void SubtractTransposedProduct(
    int width, int rows, const double* L, int stride, const double* x, double* y) {
  ForThisMachine().transposed_product(width, rows, L, stride, x, y);
}

}  // namespace ceres_ed
