#include "ceres_ed/slam/frame/window_sums.h"

#include <ceres_ed/util/for_each_machine.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>

namespace ceres_ed {
namespace {

// A pixel that is nearer than z0 by this factor makes sums that lose too many digits when it is
// removed from them.
constexpr double kExtremeRatio = 100.0;

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

// Adds the rows at +dv and -dv to the sums over columns.
CERES_ED_FOR_EACH_MACHINE
void AddRows(const double* below,
             const double* above,
             double dv,
             int count,
             double* __restrict w,
             double* __restrict vw,
             double* __restrict ww) {
  for (int c = 0; c < count; ++c) {
    w[c] += below[c] + above[c];
    vw[c] += dv * (below[c] - above[c]);
    ww[c] += below[c] * below[c] + above[c] * above[c];
  }
}

// Adds sums over the columns at +du and -du to the sums over windows.
CERES_ED_FOR_EACH_MACHINE
void AddColumns(const double* right,
                const double* left,
                double du,
                int count,
                double* __restrict sum,
                double* __restrict usum) {
  for (int i = 0; i < count; ++i) {
    sum[i] += right[i] + left[i];
    usum[i] += du * (right[i] - left[i]);
  }
}

CERES_ED_FOR_EACH_MACHINE
void AddColumns(const double* right, const double* left, int count, double* __restrict sum) {
  for (int i = 0; i < count; ++i) sum[i] += right[i] + left[i];
}

// Multiplies the sums of inverse depths by z0.
CERES_ED_FOR_EACH_MACHINE
void Scale(const double* middle,
           int count,
           double* __restrict q,
           double* __restrict uq,
           double* __restrict vq,
           double* __restrict qq) {
  for (int i = 0; i < count; ++i) {
    q[i] *= middle[i];
    uq[i] *= middle[i];
    vq[i] *= middle[i];
    qq[i] *= middle[i] * middle[i];
  }
}

// Pixel (k, -ring) of the first of some windows, and the pixels to which turns by 90 degrees about
// the middle carry it: (ring, k), (-k, ring) and (-ring, -k). Those of the next windows follow.
using Quad = std::array<const double*, 4>;

// Unlike std::min() and std::max(), these become one instruction.
inline double Lesser(double a, double b) { return a < b ? a : b; }
inline double Greater(double a, double b) { return a > b ? a : b; }

// Extends the ranges of the windows by four pixels.
CERES_ED_FOR_EACH_MACHINE
void Extend(const Quad& quad, int count, double* __restrict low, double* __restrict high) {
  const auto [a, b, c, d] = quad;
  for (int i = 0; i < count; ++i) {
    low[i] = Lesser(Lesser(a[i], b[i]), Lesser(low[i], Lesser(c[i], d[i])));
    high[i] = Greater(Greater(a[i], b[i]), Greater(high[i], Greater(c[i], d[i])));
  }
}

// Four pixels of a ring in some windows.
struct RingPart {
  Quad quad;
  double k;
  double ring;
  // Pixels whose q is less than the first bound or greater than the second one do not belong.
  double least;
  double most;
  // z0 of each window.
  const double* middle;

  bool Contains(double q) const { return (q >= least) & (q <= most); }
};

// Removes those of four pixels that do not belong to the surface from the sums that contain q.
CERES_ED_FOR_EACH_MACHINE
void RemoveInverses(const RingPart& part,
                    int count,
                    double* __restrict q,
                    double* __restrict uq,
                    double* __restrict vq,
                    double* __restrict qq) {
  const RingPart p = part;
  const auto [pixel_a, pixel_b, pixel_c, pixel_d] = p.quad;
  for (int i = 0; i < count; ++i) {
    const double q_a = p.middle[i] * pixel_a[i];
    const double q_b = p.middle[i] * pixel_b[i];
    const double q_c = p.middle[i] * pixel_c[i];
    const double q_d = p.middle[i] * pixel_d[i];
    const double a = p.Contains(q_a) ? 0.0 : q_a;
    const double b = p.Contains(q_b) ? 0.0 : q_b;
    const double c = p.Contains(q_c) ? 0.0 : q_c;
    const double d = p.Contains(q_d) ? 0.0 : q_d;
    q[i] -= (a + c) + (b + d);
    uq[i] -= p.k * (a - c) + p.ring * (b - d);
    vq[i] -= p.k * (b - d) - p.ring * (a - c);
    qq[i] -= (a * a + c * c) + (b * b + d * d);
  }
}

// Removes them from the other sums.
CERES_ED_FOR_EACH_MACHINE
void RemovePlaces(const RingPart& part,
                  int count,
                  double* __restrict n,
                  double* __restrict u,
                  double* __restrict v,
                  double* __restrict uu,
                  double* __restrict uv,
                  double* __restrict vv) {
  const RingPart p = part;
  const auto [pixel_a, pixel_b, pixel_c, pixel_d] = p.quad;
  const double kk = p.k * p.k;
  const double rr = p.ring * p.ring;
  for (int i = 0; i < count; ++i) {
    const double counted = p.middle[i] > 0.0 ? 1.0 : 0.0;
    const double a = p.Contains(p.middle[i] * pixel_a[i]) ? 0.0 : counted;
    const double b = p.Contains(p.middle[i] * pixel_b[i]) ? 0.0 : counted;
    const double c = p.Contains(p.middle[i] * pixel_c[i]) ? 0.0 : counted;
    const double d = p.Contains(p.middle[i] * pixel_d[i]) ? 0.0 : counted;
    n[i] -= (a + c) + (b + d);
    u[i] -= p.k * (a - c) + p.ring * (b - d);
    v[i] -= p.k * (b - d) - p.ring * (a - c);
    uu[i] -= kk * (a + c) + rr * (b + d);
    uv[i] -= p.k * p.ring * ((b + d) - (a + c));
    vv[i] -= rr * (a + c) + kk * (b + d);
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
  for (int ring = 0; ring <= radius_; ++ring) {
    const double step = options.max_step * std::max(ring, 1);
    least_.push_back(1.0 / (1.0 + step));
    most_.push_back(step < 1.0 ? 1.0 / (1.0 - step) : std::numeric_limits<double>::max());
  }
  for (int du = 1; du <= radius_; ++du) full_square_ += 2.0 * du * du * size_;
  const int row_size = cell_ * part_size_;
  inverse_.assign(static_cast<std::size_t>(size_) * row_size, 0.0);
  line_.resize(depth.width());
  for (auto* sum : {&columns_.w, &columns_.vw, &columns_.ww}) sum->resize(row_size);
  pixels_.resize(static_cast<std::size_t>(size_) * size_);
  middle_.resize(count_);
  for (auto* sum : Sums()) sum->resize(count_);
}

std::array<std::vector<double>*, 10> WindowSummer::Sums() {
  WindowSums& s = sums_;
  return {&s.n, &s.u, &s.v, &s.uu, &s.uv, &s.vv, &s.q, &s.uq, &s.vq, &s.qq};
}

int WindowSummer::Column(int u) const {
  // The column is never negative.
  const int column = u + margin_ * cell_;
  return column % cell_ * part_size_ + column / cell_;
}

double* WindowSummer::Row(int v) {
  // Rows above the picture have negative numbers.
  const std::size_t slot = (v + size_) % size_;
  return inverse_.data() + slot * cell_ * part_size_;
}

void WindowSummer::ReadRow(int v) {
  double* row = Row(v);
  if (v < 0 || v >= depth_.height()) {
    std::fill_n(row, cell_ * part_size_, 0.0);
    return;
  }
  const int width = depth_.width();
  Invert(depth_.pixels() + static_cast<std::size_t>(v) * width, width, line_.data());
  for (int p = 0; p < std::min(cell_, width); ++p) {
    double* part = row + Column(p);
    for (int u = p; u < width; u += cell_) *part++ = line_[u];
  }
}

void WindowSummer::SumColumns(int v0) {
  const int row_size = cell_ * part_size_;
  const double* middle = Row(v0);
  ColumnSums& sums = columns_;
  for (int c = 0; c < row_size; ++c) {
    sums.w[c] = middle[c];
    sums.vw[c] = 0.0;
    sums.ww[c] = middle[c] * middle[c];
  }
  for (int dv = 1; dv <= radius_; ++dv) {
    AddRows(
        Row(v0 + dv), Row(v0 - dv), dv, row_size, sums.w.data(), sums.vw.data(), sums.ww.data());
  }
}

const WindowSums& WindowSummer::SumRow(int v0) {
  const int first = v0 - radius_;
  const int last = v0 + radius_;
  if (next_row_ < first || next_row_ > last + 1) next_row_ = first;
  for (; next_row_ <= last; ++next_row_) ReadRow(next_row_);
  SumColumns(v0);
  const bool is_cut = (count_ - 1) * cell_ + cell_ / 2 >= depth_.width();
  SumWindows(0, is_cut ? count_ - 1 : count_, cell_ / 2, v0);
  if (is_cut) SumWindows(count_ - 1, count_, depth_.width() - 1, v0);
  return sums_;
}

// Sums the windows [begin, end), the first of which is around column u0.
void WindowSummer::SumWindows(int begin, int end, int u0, int v0) {
  const double** pixel = pixels_.data();
  for (int dv = -radius_; dv <= radius_; ++dv) {
    for (int du = -radius_; du <= radius_; ++du) {
      *pixel++ = Row(v0 + dv) + Column(u0 + du) - begin;
    }
  }
  const double* inverse = Row(v0) + Column(u0) - begin;
  for (int i = begin; i < end; ++i) {
    middle_[i] = inverse[i] > 0.0 ? depth_(u0 + (i - begin) * cell_, v0) : 0.0F;
  }
  for (int from = begin; from < end; from += kChunk) {
    const int to = std::min(from + kChunk, end);
    if (TakeAllPixels(from, to, u0 + (from - begin) * cell_)) RemoveOutliers(from, to);
  }
}

// Sums all pixels of the windows [from, to), the first of which is around a column. Returns false
// if none of them has a middle.
bool WindowSummer::TakeAllPixels(int from, int to, int column) {
  const int count = to - from;
  WindowSums& s = sums_;
  for (auto* sum : Sums()) std::fill_n(sum->begin() + from, count, 0.0);
  const auto has_depth = [](double z) { return z > 0.0; };
  if (std::none_of(&middle_[from], &middle_[from] + count, has_depth)) return false;
  std::fill_n(&s.n[from], count, full_count());
  std::fill_n(&s.uu[from], count, full_square_);
  std::fill_n(&s.vv[from], count, full_square_);
  const int middle = Column(column);
  std::copy_n(&columns_.w[middle], count, &s.q[from]);
  std::copy_n(&columns_.vw[middle], count, &s.vq[from]);
  std::copy_n(&columns_.ww[middle], count, &s.qq[from]);
  for (int du = 1; du <= radius_; ++du) {
    const int right = Column(column + du);
    const int left = Column(column - du);
    AddColumns(&columns_.w[right], &columns_.w[left], du, count, &s.q[from], &s.uq[from]);
    AddColumns(&columns_.vw[right], &columns_.vw[left], count, &s.vq[from]);
    AddColumns(&columns_.ww[right], &columns_.ww[left], count, &s.qq[from]);
  }
  Scale(&middle_[from], count, &s.q[from], &s.uq[from], &s.vq[from], &s.qq[from]);
  return true;
}

// Removes the pixels that do not belong to the surface from the sums of the windows [from, to).
void WindowSummer::RemoveOutliers(int from, int to) {
  std::array<double, kChunk> largest;
  for (int i = from; i < to; ++i) {
    if (middle_[i] == 0.0) sums_.n[i] = sums_.uu[i] = sums_.vv[i] = 0.0;
    largest[i - from] = 0.0;
  }
  for (int ring = 1; ring <= radius_; ++ring) {
    const RingRange range = RangeOfRing(from, to, ring);
    int first = to;
    int last = from;
    for (int i = from; i < to; ++i) {
      const double q_high = middle_[i] * range.high[i - from];
      largest[i - from] = std::max(largest[i - from], q_high);
      const bool belongs =
          middle_[i] * range.low[i - from] >= least_[ring] && q_high <= most_[ring];
      if (belongs || middle_[i] == 0.0) continue;
      first = std::min(first, i);
      last = i + 1;
    }
    if (first < last) RemoveOutliersOfRing(first, last, ring);
  }
  for (int i = from; i < to; ++i) {
    if (largest[i - from] > kExtremeRatio) SumPixels(i);
  }
}

WindowSummer::RingRange WindowSummer::RangeOfRing(int from, int to, int ring) const {
  RingRange range;
  range.low.fill(std::numeric_limits<double>::max());
  range.high.fill(0.0);
  for (int k = -ring; k < ring; ++k) {
    Extend(QuadAt(from, k, ring), to - from, range.low.data(), range.high.data());
  }
  return range;
}

void WindowSummer::RemoveOutliersOfRing(int from, int to, int ring) {
  const int count = to - from;
  WindowSums& s = sums_;
  for (int k = -ring; k < ring; ++k) {
    const RingPart part = {QuadAt(from, k, ring),
                           static_cast<double>(k),
                           static_cast<double>(ring),
                           least_[ring],
                           most_[ring],
                           &middle_[from]};
    RemoveInverses(part, count, &s.q[from], &s.uq[from], &s.vq[from], &s.qq[from]);
    RemovePlaces(
        part, count, &s.n[from], &s.u[from], &s.v[from], &s.uu[from], &s.uv[from], &s.vv[from]);
  }
}

// Sums the pixels of one window that belong to the surface one by one.
void WindowSummer::SumPixels(int i) {
  WindowSums& s = sums_;
  for (auto* sum : Sums()) (*sum)[i] = 0.0;
  for (int dv = -radius_; dv <= radius_; ++dv) {
    for (int du = -radius_; du <= radius_; ++du) {
      const int ring = std::max(std::abs(du), std::abs(dv));
      const double q = middle_[i] * Pixels(du, dv)[i];
      if (q < least_[ring] || q > most_[ring]) continue;
      s.n[i] += 1.0;
      s.u[i] += du;
      s.v[i] += dv;
      s.uu[i] += du * du;
      s.uv[i] += du * dv;
      s.vv[i] += dv * dv;
      s.q[i] += q;
      s.uq[i] += du * q;
      s.vq[i] += dv * q;
      s.qq[i] += q * q;
    }
  }
}

}  // namespace ceres_ed
