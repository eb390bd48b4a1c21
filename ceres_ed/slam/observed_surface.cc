#include "ceres_ed/slam/observed_surface.h"

#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace ceres_ed {
namespace {

// Of the pixels in a window, this share must have a depth that belongs to the surface.
constexpr double kMinCoverage = 0.4;

// Sums for the least-squares plane of inverse depths, in pixels from the window's centre.
struct PlaneSums {
  double n = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0, q = 0, uq = 0, vq = 0, qq = 0;

  void Add(double du, double dv, double inverse) {
    n += 1.0;
    u += du;
    v += dv;
    uu += du * du;
    uv += du * dv;
    vv += dv * dv;
    q += inverse;
    uq += du * inverse;
    vq += dv * inverse;
    qq += inverse * inverse;
  }
};

// Fits patches of one depth image.
class PatchFitter {
 public:
  PatchFitter(const DepthImage& depth,
              const PinholeCamera& camera,
              double scale,
              const ObservedSurfaceOptions& options)
      : depth_(depth),
        camera_(camera),
        scale_(scale),
        radius_(options.radius),
        max_step_(std::tan(options.max_slope_deg * M_PI / 180.0) / std::min(camera.fx, camera.fy)),
        min_count_(kMinCoverage * (2 * radius_ + 1) * (2 * radius_ + 1)) {}

  SurfacePatch Fit(int u0, int v0) const;

 private:
  const DepthImage& depth_;
  const PinholeCamera& camera_;
  double scale_;
  int radius_;
  // Largest change of depth a pixel, relative to the depth.
  double max_step_;
  double min_count_;
};

SurfacePatch PatchFitter::Fit(int u0, int v0) const {
  SurfacePatch patch;
  const double z0 = depth_(u0, v0);
  if (!(z0 > 0.0) || !std::isfinite(z0)) return patch;
  PlaneSums s;
  const int u_end = std::min(depth_.width() - 1, u0 + radius_);
  const int v_end = std::min(depth_.height() - 1, v0 + radius_);
  for (int v = std::max(0, v0 - radius_); v <= v_end; ++v) {
    for (int u = std::max(0, u0 - radius_); u <= u_end; ++u) {
      const double z = depth_(u, v);
      const int steps = std::max({std::abs(u - u0), std::abs(v - v0), 1});
      if (!(z > 0.0) || !(std::abs(z - z0) <= max_step_ * steps * z0)) continue;
      s.Add(u - u0, v - v0, z0 / z);
    }
  }
  if (s.n < min_count_) return patch;
  Eigen::Matrix3d normal_matrix;
  normal_matrix << s.uu, s.uv, s.u, s.uv, s.vv, s.v, s.u, s.v, s.n;
  const Eigen::Vector3d right(s.uq, s.vq, s.q);
  Eigen::Matrix3d inverse;
  bool invertible = false;
  normal_matrix.computeInverseWithCheck(inverse, invertible, 1e-3);
  if (!invertible) return patch;
  const Eigen::Vector3d abc = inverse * right;
  if (!(abc.z() > 0.0)) return patch;
  const double squares = std::max(0.0, s.qq - abc.dot(right));
  // 1 = (a fx) X + (b fy) Y + (c + a (cx - u0) + b (cy - v0)) Z, lengths in z0.
  const Eigen::Vector3d plane(abc.x() * camera_.fx,
                              abc.y() * camera_.fy,
                              abc.z() + abc.x() * (camera_.cx - u0) + abc.y() * (camera_.cy - v0));
  patch.point = camera_.BackProject(u0, v0, z0 * scale_ / abc.z());
  patch.normal = -plane.normalized();
  // The spread of z0 / z is that of z / z0 to first order; three degrees of freedom are gone.
  patch.deviation = std::sqrt(squares / (s.n - 3.0)) * z0 * scale_;
  return patch;
}

}  // namespace

ObservedSurface::ObservedSurface(const DepthImage& depth,
                                 const PinholeCamera& camera,
                                 double scale,
                                 const ObservedSurfaceOptions& options)
    : camera_(camera),
      cell_(options.cell),
      patches_((depth.width() + options.cell - 1) / options.cell,
               (depth.height() + options.cell - 1) / options.cell) {
  const PatchFitter fitter(depth, camera, scale, options);
  ParallelFor(options.num_threads, patches_.height(), [&](int begin, int end) {
    for (int j = begin; j < end; ++j) {
      for (int i = 0; i < patches_.width(); ++i) {
        // The middle of the cell; the last ones may be cut off.
        const int u = std::min(i * cell_ + cell_ / 2, depth.width() - 1);
        const int v = std::min(j * cell_ + cell_ / 2, depth.height() - 1);
        patches_(i, j) = fitter.Fit(u, v);
      }
    }
  });
  std::vector<double> deviations;
  for (const SurfacePatch& patch : patches_.pixels()) {
    if (patch.valid()) deviations.push_back(patch.deviation);
  }
  num_valid_ = static_cast<int>(deviations.size());
  if (deviations.empty()) return;
  const auto middle = deviations.begin() + num_valid_ / 2;
  std::nth_element(deviations.begin(), middle, deviations.end());
  noise_ = *middle;
}

}  // namespace ceres_ed
