#include "ceres_ed/slam/frame/window_sums.h"

#include <ceres_ed/util/for_each_machine.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace ceres_ed {
namespace {

// The number of windows that are processed together.
constexpr int kChunk = 32;

// A row of pixels of the windows [begin, end), in the form that the kernels use.
struct PixelRow {
  int begin;
  int end;
  // The row relative to the windows' middles, and the number of columns to either side.
  int dv;
  int radius;
  // Pixel (du, dv) of window i is pixels[du + radius][i].
  const double* const* pixels;
  // z0 of each window.
  const double* middle;
  // The bounds of q for each column.
  const double* least;
  const double* most;
};

// Computes the inverse of depths; 0 where there is no depth.
CERES_ED_FOR_EACH_MACHINE
void Invert(const float* depth, int count, double* inverse) {
  constexpr float kLargest = std::numeric_limits<float>::max();
  for (int u = 0; u < count; ++u) {
    const bool is_depth = (depth[u] > 0.0F) & (depth[u] <= kLargest);
    const double z = is_depth ? depth[u] : 1.0F;
    inverse[u] = (is_depth ? 1.0 : 0.0) / z;
  }
}

// The default radius is a compile-time constant: with its columns unrolled, the compiler vectorises
// the loop over windows.
constexpr int kUsualRadius = WindowOptions().radius;

template <int kRadius>
[[gnu::always_inline]] inline void AddInverses(const PixelRow& row,
                                               double* __restrict n,
                                               double* __restrict q,
                                               double* __restrict uq,
                                               double* __restrict vq,
                                               double* __restrict qq) {
  const int radius = kRadius > 0 ? kRadius : row.radius;
  for (int i = row.begin; i < row.end; ++i) {
    double n_row = 0.0, q_row = 0.0, uq_row = 0.0, qq_row = 0.0;
    for (int k = 0; k < 2 * radius + 1; ++k) {
      const double ratio = row.middle[i] * row.pixels[k][i];
      const bool counts = (ratio >= row.least[k]) & (ratio <= row.most[k]);
      const double counted = counts ? ratio : 0.0;
      n_row += counts ? 1.0 : 0.0;
      q_row += counted;
      uq_row += (k - radius) * counted;
      qq_row += counted * counted;
    }
    n[i] += n_row;
    q[i] += q_row;
    uq[i] += uq_row;
    vq[i] += row.dv * q_row;
    qq[i] += qq_row;
  }
}

template <int kRadius>
[[gnu::always_inline]] inline void AddPlaces(const PixelRow& row,
                                             double* __restrict u,
                                             double* __restrict v,
                                             double* __restrict uu,
                                             double* __restrict uv,
                                             double* __restrict vv) {
  const int radius = kRadius > 0 ? kRadius : row.radius;
  for (int i = row.begin; i < row.end; ++i) {
    double n_row = 0.0, u_row = 0.0, uu_row = 0.0;
    for (int k = 0; k < 2 * radius + 1; ++k) {
      const double ratio = row.middle[i] * row.pixels[k][i];
      const bool counts = (ratio >= row.least[k]) & (ratio <= row.most[k]);
      const double du = counts ? k - radius : 0.0;
      n_row += counts ? 1.0 : 0.0;
      u_row += du;
      uu_row += du * du;
    }
    u[i] += u_row;
    v[i] += row.dv * n_row;
    uu[i] += uu_row;
    uv[i] += row.dv * u_row;
    vv[i] += row.dv * row.dv * n_row;
  }
}

// Computes n and the sums that contain q.
CERES_ED_FOR_EACH_MACHINE
void AddInverseSums(const PixelRow& row, WindowSums* sums) {
  if (row.radius == kUsualRadius) {
    AddInverses<kUsualRadius>(
        row, sums->n.data(), sums->q.data(), sums->uq.data(), sums->vq.data(), sums->qq.data());
  } else {
    AddInverses<0>(
        row, sums->n.data(), sums->q.data(), sums->uq.data(), sums->vq.data(), sums->qq.data());
  }
}

// Computes the other sums.
CERES_ED_FOR_EACH_MACHINE
void AddPlaceSums(const PixelRow& row, WindowSums* sums) {
  if (row.radius == kUsualRadius) {
    AddPlaces<kUsualRadius>(
        row, sums->u.data(), sums->v.data(), sums->uu.data(), sums->uv.data(), sums->vv.data());
  } else {
    AddPlaces<0>(
        row, sums->u.data(), sums->v.data(), sums->uu.data(), sums->uv.data(), sums->vv.data());
  }
}

}  // namespace

WindowSummer::WindowSummer(DepthView depth, const WindowOptions& options)
    : depth_(depth),
      cell_(options.cell),
      radius_(options.radius),
      size_(2 * options.radius + 1),
      count_((depth.width() + options.cell - 1) / options.cell),
      margin_(options.radius / options.cell + 1),
      part_size_(count_ + 2 * margin_) {
  for (int dv = 0; dv <= radius_; ++dv) {
    for (int du = -radius_; du <= radius_; ++du) {
      const double step = options.max_step * std::max({std::abs(du), dv, 1});
      least_.push_back(1.0 / (1.0 + step));
      most_.push_back(step < 1.0 ? 1.0 / (1.0 - step) : std::numeric_limits<double>::max());
    }
  }
  for (int du = 1; du <= radius_; ++du) full_square_ += 2.0 * du * du * size_;
  inverse_.assign(static_cast<std::size_t>(size_) * cell_ * part_size_, 0.0);
  line_.resize(depth.width());
  pixels_.resize(static_cast<std::size_t>(size_) * size_);
  middle_.resize(count_);
  for (auto* sum : Sums()) sum->resize(count_);
}

std::array<std::vector<double>*, 10> WindowSummer::Sums() {
  WindowSums& s = sums_;
  return {&s.n, &s.u, &s.v, &s.uu, &s.uv, &s.vv, &s.q, &s.uq, &s.vq, &s.qq};
}

double* WindowSummer::Pixel(int u, int v) {
  // The column is never negative.
  const int column = u + margin_ * cell_;
  const std::size_t part = static_cast<std::size_t>(v % size_) * cell_ + column % cell_;
  return inverse_.data() + part * part_size_ + column / cell_;
}

void WindowSummer::ReadRow(int v) {
  const int width = depth_.width();
  Invert(depth_.pixels() + static_cast<std::size_t>(v) * width, width, line_.data());
  for (int p = 0; p < std::min(cell_, width); ++p) {
    double* part = Pixel(p, v);
    for (int u = p; u < width; u += cell_) *part++ = line_[u];
  }
}

const WindowSums& WindowSummer::SumRow(int v0) {
  const int first = std::max(0, v0 - radius_);
  const int last = std::min(depth_.height() - 1, v0 + radius_);
  if (next_row_ < first || next_row_ > last + 1) next_row_ = first;
  for (; next_row_ <= last; ++next_row_) ReadRow(next_row_);
  for (std::vector<double>* sum : Sums()) std::fill(sum->begin(), sum->end(), 0.0);
  const bool is_cut = (count_ - 1) * cell_ + cell_ / 2 >= depth_.width();
  SumWindows(0, is_cut ? count_ - 1 : count_, cell_ / 2, v0);
  if (is_cut) SumWindows(count_ - 1, count_, depth_.width() - 1, v0);
  return sums_;
}

// Sums the windows [begin, end), the first of which is around column u0.
void WindowSummer::SumWindows(int begin, int end, int u0, int v0) {
  const double* inverse = Pixel(u0, v0) - begin;
  for (int i = begin; i < end; ++i) {
    middle_[i] = inverse[i] > 0.0 ? depth_(u0 + (i - begin) * cell_, v0) : 0.0F;
  }
  for (int v = std::max(0, v0 - radius_); v <= std::min(depth_.height() - 1, v0 + radius_); ++v) {
    const double** pixels = &pixels_[static_cast<std::size_t>(v - v0 + radius_) * size_];
    for (int k = 0; k < size_; ++k) pixels[k] = Pixel(u0 + k - radius_, v) - begin;
  }
  const auto add_rows = [&](int from, int to, void (*add)(const PixelRow&, WindowSums*)) {
    for (int v = std::max(0, v0 - radius_); v <= std::min(depth_.height() - 1, v0 + radius_); ++v) {
      const std::size_t bounds = static_cast<std::size_t>(std::abs(v - v0)) * size_;
      add({from,
           to,
           v - v0,
           radius_,
           &pixels_[static_cast<std::size_t>(v - v0 + radius_) * size_],
           middle_.data(),
           &least_[bounds],
           &most_[bounds]},
          &sums_);
    }
  };
  for (int from = begin; from < end; from += kChunk) {
    const int to = std::min(from + kChunk, end);
    const auto is_empty = [](double z) { return z == 0.0; };
    if (std::all_of(&middle_[from], &middle_[from] + (to - from), is_empty)) continue;
    add_rows(from, to, AddInverseSums);
    bool full = true;
    for (int i = from; i < to; ++i) full = full && IsFull(i);
    if (full) {
      std::fill_n(&sums_.uu[from], to - from, full_square_);
      std::fill_n(&sums_.vv[from], to - from, full_square_);
    } else {
      add_rows(from, to, AddPlaceSums);
    }
  }
}

}  // namespace ceres_ed
