// The nearest depth in each cell of an image.
#ifndef CERES_ED_GEOMETRY_Z_BUFFER_H_
#define CERES_ED_GEOMETRY_Z_BUFFER_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>

#include <algorithm>
#include <limits>

#include <Eigen/Core>

namespace ceres_ed {

// A buffer whose cells are squares of `cell` x `cell` pixels of the camera's image. T is the type
// in which a depth is stored.
template <typename T>
class ZBuffer {
 public:
  // Starts without any depth.
  explicit ZBuffer(const PinholeCamera& camera, int cell = 1)
      : cell_(cell),
        nearest_((camera.width + cell - 1) / cell,
                 (camera.height + cell - 1) / cell,
                 std::numeric_limits<T>::infinity()) {}

  // Adds a depth at pixel (u, v), which must be inside the image.
  void Add(int u, int v, double z) {
    T& nearest = nearest_(u / cell_, v / cell_);
    nearest = std::min(nearest, static_cast<T>(z));
  }

  // Returns the nearest depth in the cell of pixel (u, v); infinite if there is none.
  double At(int u, int v) const { return nearest_(u / cell_, v / cell_); }

  // The side of a cell in pixels.
  int cell() const { return cell_; }

 private:
  int cell_;
  Image<T> nearest_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_Z_BUFFER_H_
