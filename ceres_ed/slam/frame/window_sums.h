// Computes sums over windows of a depth image for least-squares planes, one row of windows at a
// time.
//
// Nearly all pixels of a window belong to the surface at its middle. So the sums are first taken
// over all pixels, which are sums over columns that neighbouring windows share: a window costs as
// many steps as it has columns. Then the few pixels that do not belong are removed. They are found
// ring by ring around the middle: the least and the greatest depth of a ring tell whether all of
// its pixels belong. No sum depends on the windows or rows that were processed before.
#ifndef CERES_ED_SLAM_FRAME_WINDOW_SUMS_H_
#define CERES_ED_SLAM_FRAME_WINDOW_SUMS_H_

#include <ceres_ed/geometry/images.h>

#include <array>
#include <limits>
#include <vector>

namespace ceres_ed {

// Options of WindowSummer.
struct WindowOptions {
  // The spacing of the windows in pixels, >= 1; default 2.
  int cell = 2;
  // A window has (2 radius + 1)^2 pixels; >= 1, default 3.
  int radius = 3;
  // The largest change of depth per pixel, relative to the depth, > 0; default 0.01. Pixels that
  // differ by more do not belong to the surface.
  double max_step = 0.01;
};

// Sums over the pixels of a window that belong to the surface at its middle. du and dv are relative
// to the middle, and q = z0 / z is the inverse depth relative to that of the middle. Each vector
// has one value per window.
struct WindowSums {
  std::vector<double> n, u, v, uu, uv, vv, q, uq, vq, qq;
};

// Computes the sums of one row of windows after the other. Each thread needs its own object.
class WindowSummer {
 public:
  // `depth` must outlive this object.
  WindowSummer(DepthView depth, const WindowOptions& options);

  // Returns the sums over the windows around the pixels (u, v0) with u = cell i + cell / 2 for i <
  // count(); the last window is moved to the border of the picture if it would be beyond. All sums
  // are 0 if the middle has no depth. Rows in ascending order are fast, because they share their
  // pixels.
  const WindowSums& SumRow(int v0);

  // Returns the number of windows in a row, which is the number of cells in a row of the picture.
  int count() const { return count_; }
  // Returns whether all pixels of a window of the last row belong to the surface. Then n is
  // full_count(), uu and vv are full_square(), and u, v and uv are 0.
  bool IsFull(int i) const { return sums_.n[i] == full_count(); }
  double full_count() const { return static_cast<double>(size_ * size_); }
  double full_square() const { return full_square_; }

 private:
  // Sums over the columns of the windows: of the inverse depth w, of dv w, and of w^2.
  struct ColumnSums {
    std::vector<double> w, vw, ww;
  };
  // The number of windows that are processed together.
  static constexpr int kChunk = 32;
  // The least and the greatest 1 / z of the pixels of a ring, for each window of a chunk.
  struct RingRange {
    std::array<double, kChunk> low;
    std::array<double, kChunk> high;
  };

  // Returns the place of a column in a row of inverse_.
  int Column(int u) const;
  double* Row(int v);
  void ReadRow(int v);
  void SumColumns(int v0);
  void SumWindows(int begin, int end, int u0, int v0);
  bool TakeAllPixels(int from, int to, int column);
  void RemoveOutliers(int from, int to);
  RingRange RangeOfRing(int from, int to, int ring) const;
  void RemoveOutliersOfRing(int from, int to, int ring);
  void SumPixels(int i);
  std::array<std::vector<double>*, 10> Sums();
  // Returns 1 / z at (du, dv) from the middles of the windows.
  const double* Pixels(int du, int dv) const {
    return pixels_[(dv + radius_) * size_ + du + radius_];
  }
  // Returns pixel (k, -ring) of window i, and what turns by 90 degrees make of it.
  std::array<const double*, 4> QuadAt(int i, int k, int ring) const {
    return {Pixels(k, -ring) + i, Pixels(ring, k) + i, Pixels(-k, ring) + i, Pixels(-ring, -k) + i};
  }

  DepthView depth_;
  int cell_;
  int radius_;
  // The side of a window in pixels.
  int size_;
  int count_;
  double full_square_ = 0.0;
  // The bounds of q in each ring, which is the pixels with the same max(|du|, |dv|).
  std::vector<double> least_;
  std::vector<double> most_;
  // The number of cells to the left and right of the picture, and the number of cells for which
  // there is memory.
  int margin_;
  int part_size_;
  // 1 / z of the rows that were read last, as many as a window has; 0 where nothing was measured,
  // and around the picture. Columns cell k + p with the same p are adjacent in memory, so that the
  // columns of neighbouring windows are adjacent.
  std::vector<double> inverse_;
  std::vector<double> line_;
  int next_row_ = std::numeric_limits<int>::min();
  ColumnSums columns_;
  // For the windows that are processed: z0, and the addresses of their pixels.
  std::vector<double> middle_;
  std::vector<const double*> pixels_;
  WindowSums sums_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_WINDOW_SUMS_H_
