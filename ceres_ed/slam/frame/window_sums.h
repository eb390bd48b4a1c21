// Sums over windows of a depth image for least-squares planes, a row of windows at once.
#ifndef CERES_ED_SLAM_FRAME_WINDOW_SUMS_H_
#define CERES_ED_SLAM_FRAME_WINDOW_SUMS_H_

#include <ceres_ed/geometry/images.h>

#include <array>
#include <cstddef>
#include <vector>

namespace ceres_ed {

struct WindowOptions {
  // Pixels from window to window, >= 1.
  int cell = 2;
  // A window has (2 radius + 1)^2 pixels, >= 1.
  int radius = 3;
  // Largest change of depth a pixel, relative to the depth; what is farther off isn't of the
  // surface. > 0.
  double max_step = 0.01;
};

// Over the pixels of a window that belong to the surface at its middle: du and dv count from
// there, q = z0 / z is the inverse depth relative to that of the middle. One number a window.
struct WindowSums {
  std::vector<double> n, u, v, uu, uv, vv, q, uq, vq, qq;
};

// Sums over one row of windows after the other. One object a thread.
class WindowSummer {
 public:
  // `depth` must outlive it.
  WindowSummer(DepthView depth, const WindowOptions& options);

  // Sums over the windows around the pixels (u, v0) with u = cell i + cell / 2 for i < count(), the
  // last one at the picture's border where it would be beyond. All are 0 where the middle has no
  // depth. Quick for rows in ascending order: they share their pixels.
  const WindowSums& SumRow(int v0);

  // As many windows as a row of the picture has cells.
  int count() const { return count_; }
  // Whether all pixels of a window of the last row count. Then n is full_count(), uu and vv are
  // full_square(), and u, v and uv are 0.
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
  // Side of a window.
  int size_;
  int count_;
  double full_square_ = 0.0;
  // Bounds of q by |dv| and du.
  std::vector<double> least_;
  std::vector<double> most_;
  // 1 / z of the rows read last, as many as a window has; 0 where nothing was measured, and left
  // and right of the picture. Columns cell k + p of one p stand side by side, so that those of
  // neighbouring windows do.
  std::vector<double> inverse_;
  std::vector<double> line_;
  // Cells left and right of the picture, and cells that there is room for.
  int margin_;
  int part_size_;
  int next_row_ = 0;
  // Of the last row: z0, where windows have their pixels, and what they sum up to.
  std::vector<double> middle_;
  std::vector<const double*> pixels_;
  WindowSums sums_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_WINDOW_SUMS_H_
