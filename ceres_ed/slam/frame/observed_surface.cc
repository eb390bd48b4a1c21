#include "ceres_ed/slam/frame/observed_surface.h"

#include <ceres_ed/slam/frame/window_sums.h>
#include <ceres_ed/util/parallel.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>

namespace ceres_ed {
namespace {

// The share of the pixels in a window that must have a depth that belongs to the surface.
constexpr double kMinCoverage = 0.4;

// The number of patches from which the noise is computed. All patches are not needed, because
// neighbours have most of their pixels in common.
constexpr int kNoiseSamples = 20000;

// A larger radius would smooth away the shape.
constexpr int kLargestRadius = 12;

// Returns the deviation of the slope of a plane from noise of deviation 1 pixel distance. The slope
// of a plane through the n = (2 r + 1)^2 pixels of a window has the deviation
// noise / sqrt(n r (r + 1) / 3) per pixel.
double SlopeNoise(int radius) {
  const double r = radius;
  return 1.0 / ((2.0 * r + 1.0) * std::sqrt(r * (r + 1.0) / 3.0));
}

// Returns the median deviation of every `step`-th valid patch; 0 if there is none.
double MedianOfDeviations(const std::vector<SurfacePatch>& patches, int step) {
  std::vector<double> deviations;
  deviations.reserve(patches.size() / step + 1);
  int skip = 0;
  for (const SurfacePatch& patch : patches) {
    if (!patch.valid() || skip-- > 0) continue;
    skip = step - 1;
    deviations.push_back(patch.deviation);
  }
  return Median(std::move(deviations));
}

// Returns the median depth of some valid patches; 0 if there are none.
double MedianDepth(const std::vector<SurfacePatch>& patches) {
  const std::size_t step = 1 + patches.size() / kNoiseSamples;
  std::vector<double> depths;
  for (std::size_t k = 0; k < patches.size(); k += step) {
    if (patches[k].valid()) depths.push_back(patches[k].point.z());
  }
  return Median(std::move(depths));
}

// Fits patches to sums over windows.
class PatchFitter {
 public:
  PatchFitter(DepthView depth,
              const PinholeCamera& camera,
              double scale,
              const WindowOptions& options)
      : depth_(depth),
        camera_(camera),
        scale_(scale),
        cell_(options.cell),
        windows_(depth, options) {
    const double side = 2 * options.radius + 1;
    min_count_ = kMinCoverage * side * side;
  }

  // Writes the patches of a row of cells whose middle is at row v0.
  void FitRow(int v0, SurfacePatch* patches) {
    const WindowSums& sums = windows_.SumRow(v0);
    for (int i = 0; i < windows_.count(); ++i) {
      if (sums.n[i] < min_count_) continue;
      const int u0 = std::min(i * cell_ + cell_ / 2, depth_.width() - 1);
      Eigen::Vector3d abc;
      if (SolvePlane(sums, i, &abc)) SetPatch(u0, v0, sums, i, abc, &patches[i]);
    }
  }

 private:
  // Solves the least-squares fit q = a du + b dv + c. Returns false if the pixels do not determine
  // it.
  bool SolvePlane(const WindowSums& s, int i, Eigen::Vector3d* abc) const {
    if (windows_.IsFull(i)) {
      *abc = {s.uq[i] / windows_.full_square(),
              s.vq[i] / windows_.full_square(),
              s.q[i] / windows_.full_count()};
      return true;
    }
    Eigen::Matrix3d normal_matrix;
    normal_matrix << s.uu[i], s.uv[i], s.u[i], s.uv[i], s.vv[i], s.v[i], s.u[i], s.v[i], s.n[i];
    Eigen::Matrix3d inverse;
    bool invertible = false;
    normal_matrix.computeInverseWithCheck(inverse, invertible, 1e-3);
    if (!invertible) return false;
    *abc = inverse * Eigen::Vector3d(s.uq[i], s.vq[i], s.q[i]);
    return abc->z() > 0.0;
  }

  void SetPatch(int u0,
                int v0,
                const WindowSums& s,
                int i,
                const Eigen::Vector3d& abc,
                SurfacePatch* patch) const {
    const double z0 = static_cast<double>(depth_(u0, v0)) * scale_;
    const double squares =
        std::max(0.0, s.qq[i] - abc.dot(Eigen::Vector3d(s.uq[i], s.vq[i], s.q[i])));
    // The plane is 1 = (a fx) X + (b fy) Y + (c + a (cx - u0) + b (cy - v0)) Z, with lengths in
    // units of z0.
    const Eigen::Vector3d plane(
        abc.x() * camera_.fx,
        abc.y() * camera_.fy,
        abc.z() + abc.x() * (camera_.cx - u0) + abc.y() * (camera_.cy - v0));
    patch->point = camera_.BackProject(u0, v0, z0 / abc.z());
    patch->normal = -plane.normalized();
    // To first order the spread of z0 / z equals that of z / z0; the fit takes three degrees of
    // freedom.
    patch->deviation = std::sqrt(squares / (s.n[i] - 3.0)) * z0;
  }

  DepthView depth_;
  const PinholeCamera& camera_;
  double scale_;
  int cell_;
  double min_count_;
  WindowSummer windows_;
};

}  // namespace

ObservedSurface::ObservedSurface(DepthView depth,
                                 const PinholeCamera& camera,
                                 double scale,
                                 const ObservedSurfaceOptions& options,
                                 const DepthNoise& model)
    : camera_(camera),
      options_(options),
      cell_(options.cell),
      patches_((depth.width() + options.cell - 1) / options.cell,
               (depth.height() + options.cell - 1) / options.cell) {
  WindowOptions windows;
  windows.cell = options.cell;
  windows.radius = options.radius;
  windows.max_step =
      std::tan(options.max_slope_deg * M_PI / 180.0) / std::min(camera.fx, camera.fy);
  ParallelFor(options.num_threads, patches_.height(), [&](int begin, int end) {
    PatchFitter fitter(depth, camera, scale, windows);
    for (int j = begin; j < end; ++j) {
      // The middle of the cell; the last cells may be cut off.
      const int v0 = std::min(j * cell_ + cell_ / 2, depth.height() - 1);
      fitter.FitRow(v0, &patches_(0, j));
    }
  });
  const auto is_valid = [](const SurfacePatch& patch) { return patch.valid(); };
  const std::vector<SurfacePatch>& patches = patches_.pixels();
  num_valid_ = static_cast<int>(std::count_if(patches.begin(), patches.end(), is_valid));
  noise_ = MedianOfDeviations(patches, 1 + num_valid_ / kNoiseSamples);
  median_depth_ = MedianDepth(patches);
  if (model.known() && num_valid_ > 0) UseModel(model.Scaled(scale));
  // Two pixels are z / f apart.
  if (median_depth_ > 0.0) {
    slope_noise_ =
        noise_ * std::min(camera.fx, camera.fy) / median_depth_ * SlopeNoise(options.radius);
  }
}

void ObservedSurface::UseModel(const DepthNoise& model) {
  noise_ = model.At(median_depth_);
  for (SurfacePatch& patch : patches_.pixels()) {
    if (patch.valid()) patch.relative_noise = model.At(patch.point.z()) / noise_;
  }
}

int ObservedSurface::RadiusForNoise() const {
  const double noise = slope_noise_ / SlopeNoise(options_.radius);
  int radius = options_.radius;
  while (radius < kLargestRadius && noise * SlopeNoise(radius) > options_.max_slope_noise) ++radius;
  return radius;
}

}  // namespace ceres_ed
