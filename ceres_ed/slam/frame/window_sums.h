// Computes sums over windows of a depth image for least-squares planes, one row of windows at a
// time.
#ifndef CERES_ED_SLAM_FRAME_WINDOW_SUMS_H_
#define CERES_ED_SLAM_FRAME_WINDOW_SUMS_H_

#include <ceres_ed/geometry/images.h>

#include <array>
#include <cstddef>
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
  double* Pixel(int u, int v);
  void ReadRow(int v);
  void SumWindows(int begin, int end, int u0, int v0);
  std::array<std::vector<double>*, 10> Sums();

  DepthView depth_;
  int cell_;
  int radius_;
  // The side of a window in pixels.
  int size_;
  int count_;
  double full_square_ = 0.0;
  // The bounds of q, by |dv| and du.
  std::vector<double> least_;
  std::vector<double> most_;
  // 1 / z of the rows that were read last, as many as a window has; 0 where nothing was measured,
  // and to the left and right of the picture. Columns cell k + p with the same p are adjacent in
  // memory, so that the columns of neighbouring windows are adjacent.
  std::vector<double> inverse_;
  std::vector<double> line_;
  // The number of cells to the left and right of the picture, and the number of cells for which
  // there is memory.
  int margin_;
  int part_size_;
  int next_row_ = 0;
  // For the last row: z0, the addresses of the windows' pixels, and their sums.
  std::vector<double> middle_;
  std::vector<const double*> pixels_;
  WindowSums sums_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_WINDOW_SUMS_H_
