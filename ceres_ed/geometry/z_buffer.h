// The nearest depth in each cell of a picture.
#ifndef CERES_ED_GEOMETRY_Z_BUFFER_H_
#define CERES_ED_GEOMETRY_Z_BUFFER_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>

#include <algorithm>
#include <limits>

#include <Eigen/Core>

namespace ceres_ed {

// Cells are squares of `cell` x `cell` pixels; pixels are those of the camera's picture. T is how a
// depth is kept.
template <typename T>
class ZBuffer {
 public:
  // Nothing is there yet.
  explicit ZBuffer(const PinholeCamera& camera, int cell = 1)
      : cell_(cell),
        nearest_((camera.width + cell - 1) / cell,
                 (camera.height + cell - 1) / cell,
                 std::numeric_limits<T>::infinity()) {}

  void Add(int u, int v, double z) {
    T& nearest = nearest_(u / cell_, v / cell_);
    nearest = std::min(nearest, static_cast<T>(z));
  }

  // Infinite where nothing is.
  double At(int u, int v) const { return nearest_(u / cell_, v / cell_); }

  // In pixels.
  int cell() const { return cell_; }

 private:
  int cell_;
  Image<T> nearest_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_Z_BUFFER_H_
