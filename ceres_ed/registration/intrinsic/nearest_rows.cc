#include "ceres_ed/registration/intrinsic/nearest_rows.h"

#include <ceres_ed/util/for_each_machine.h>

#include <algorithm>
#include <cstdint>
#include <limits>

// Vectors are passed to no function, so it does not matter how a processor would pass them.
#ifdef __GNUC__
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace ceres_ed {
namespace {

constexpr int kWidth = 16;
// The number of rows of `a` that are compared with a vector of rows of `b` at once.
constexpr int kQueries = 4;

using Floats [[gnu::vector_size(kWidth * sizeof(float)), gnu::aligned(4)]] = float;
using Ints [[gnu::vector_size(kWidth * sizeof(std::int32_t)), gnu::aligned(4)]] = std::int32_t;

// The rows of a matrix, each column padded to a multiple of kWidth rows.
struct Columns {
  explicit Columns(const Eigen::MatrixXd& matrix)
      : count(static_cast<int>(matrix.cols())),
        stride((static_cast<int>(matrix.rows()) + kWidth - 1) / kWidth * kWidth),
        values(static_cast<std::size_t>(stride) * matrix.cols(), 0.0F),
        half_norms(stride, std::numeric_limits<float>::infinity()) {
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) {
      for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
        values[c * stride + r] = static_cast<float>(matrix(r, c));
      }
    }
    for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
      half_norms[r] = static_cast<float>(0.5 * matrix.row(r).squaredNorm());
    }
  }

  int count;
  int stride;
  std::vector<float> values;
  // Half of the squared length of each row; infinite for the padding.
  std::vector<float> half_norms;
};

// The nearest rows so far: of each vector of rows of `b` for a few rows of `a`, and of all of `a`
// for each row of `b`.
struct Nearest {
  float forth[kQueries][kWidth];
  std::int32_t forth_index[kQueries][kWidth];
  std::vector<float> back;
  std::vector<std::int32_t> back_index;
};

// Compares the rows `first` to `first + kQueries - 1` of `a` with all of `b`. Distances are half
// the squared ones: |a|^2 / 2 + |b|^2 / 2 - a.b, without the first part for `forth`.
CERES_ED_FOR_EACH_MACHINE_WITH_AVX512
void Compare(const Columns& a, const Columns& b, int first, Nearest* nearest) {
  const float* of_a = a.values.data();
  const float* of_b = b.values.data();
  Floats best[kQueries];
  Ints best_index[kQueries];
  for (int q = 0; q < kQueries; ++q) {
    best[q] = Floats{} + std::numeric_limits<float>::infinity();
    best_index[q] = Ints{};
  }
  Ints index = Ints{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  for (int j = 0; j < b.stride; j += kWidth) {
    const Floats norms = *reinterpret_cast<const Floats*>(b.half_norms.data() + j);
    Floats distance[kQueries] = {norms, norms, norms, norms};
    for (int c = 0; c < b.count; ++c) {
      const Floats row =
          *reinterpret_cast<const Floats*>(of_b + static_cast<std::size_t>(c) * b.stride + j);
      const float* query = of_a + static_cast<std::size_t>(c) * a.stride + first;
      for (int q = 0; q < kQueries; ++q) distance[q] -= query[q] * row;
    }
    Floats& back = *reinterpret_cast<Floats*>(nearest->back.data() + j);
    Ints& back_index = *reinterpret_cast<Ints*>(nearest->back_index.data() + j);
    for (int q = 0; q < kQueries; ++q) {
      const Ints is_less = distance[q] < best[q];
      best[q] = is_less ? distance[q] : best[q];
      best_index[q] = is_less ? index : best_index[q];
      const Floats whole = distance[q] + a.half_norms[first + q];
      const Ints is_nearer = whole < back;
      back = is_nearer ? whole : back;
      back_index = is_nearer ? Ints{} + (first + q) : back_index;
    }
    index += kWidth;
  }
  for (int q = 0; q < kQueries; ++q) {
    *reinterpret_cast<Floats*>(nearest->forth[q]) = best[q];
    *reinterpret_cast<Ints*>(nearest->forth_index[q]) = best_index[q];
  }
}

}  // namespace

PointMap NearestRows(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const Columns of_a(a);
  const Columns of_b(b);
  Nearest nearest;
  nearest.back.assign(of_b.stride, std::numeric_limits<float>::infinity());
  nearest.back_index.assign(of_b.stride, 0);
  PointMap map;
  map.forth.resize(a.rows());
  for (int first = 0; first < a.rows(); first += kQueries) {
    Compare(of_a, of_b, first, &nearest);
    for (int q = 0; q < kQueries && first + q < a.rows(); ++q) {
      int lane = 0;
      for (int l = 1; l < kWidth; ++l) {
        const float better = nearest.forth[q][l] - nearest.forth[q][lane];
        const bool is_first = nearest.forth_index[q][l] < nearest.forth_index[q][lane];
        if (better < 0.0F || (better == 0.0F && is_first)) lane = l;
      }
      map.forth[first + q] = nearest.forth_index[q][lane];
    }
  }
  map.back.assign(nearest.back_index.begin(), nearest.back_index.begin() + b.rows());
  return map;
}

}  // namespace ceres_ed
