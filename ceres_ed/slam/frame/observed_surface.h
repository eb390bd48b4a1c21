// A depth image as a surface: smoothed points with normals on a grid of pixels.
#ifndef CERES_ED_SLAM_FRAME_OBSERVED_SURFACE_H_
#define CERES_ED_SLAM_FRAME_OBSERVED_SURFACE_H_

#include <ceres_ed/geometry/depth_noise.h>
#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/nearest_pixel.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/slam/slam_options.h>

#include <cmath>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The tangent plane of the surface at one pixel, in the camera frame.
struct SurfacePatch {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  // The normal, of unit length and toward the camera; zero if nothing was measured.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  // The spread of the measured depths about the plane, along the optical axis.
  double deviation = 0.0;
  // The noise of a pixel of the patch divided by ObservedSurface::noise(): 1 unless a model of the
  // noise says that it depends on the depth.
  double relative_noise = 1.0;

  bool valid() const { return !normal.isZero(); }
};

// Patches at every `cell` pixels. The inverse depth of a plane is an affine function of the pixel,
// so that the fit is linear: 1/z = a u + b v + c.
class ObservedSurface {
 public:
  // Lengths are those of `depth` multiplied by `scale` (map units per metre). `model` is the noise
  // of `depth`; if it is not known, the noise is measured.
  ObservedSurface(DepthView depth,
                  const PinholeCamera& camera,
                  double scale,
                  const ObservedSurfaceOptions& options,
                  const DepthNoise& model = {});

  int width() const { return patches_.width(); }
  int height() const { return patches_.height(); }
  int cell() const { return cell_; }
  const PinholeCamera& camera() const { return camera_; }
  // Returns the number of valid patches.
  int num_valid() const { return num_valid_; }
  // Returns the noise of a typical pixel along the optical axis: by the model that at the median
  // depth, otherwise the median of the patches' deviations; 0 if there are no patches.
  double noise() const { return noise_; }
  // Returns the median depth of the patches; 0 if there are none.
  double median_depth() const { return median_depth_; }
  // Returns the standard deviation of the slope of a patch that this noise produces: of the tangent
  // of the angle of its normal.
  double slope_noise() const { return slope_noise_; }

  // Returns the least radius, in [`radius` of the options, 12] pixels, with which the slopes of the
  // patches would be as certain as `max_slope_noise` asks for.
  int RadiusForNoise() const;

  const SurfacePatch& patch(int i, int j) const { return patches_(i, j); }
  // Removes a valid patch, which does not belong to the tissue.
  void Remove(int i, int j) {
    patches_(i, j).normal.setZero();
    --num_valid_;
  }
  // Returns the patch nearest to a pixel, or null if there is none or the pixel is outside the
  // picture.
  const SurfacePatch* Find(const Eigen::Vector2d& pixel) const {
    const SurfacePatch* patch = At(pixel);
    return patch != nullptr && patch->valid() ? patch : nullptr;
  }
  // Starts to load the patch that Find() will be asked for into the cache.
  void Prefetch(const Eigen::Vector2d& pixel) const {
#if defined(__GNUC__)
    const SurfacePatch* patch = At(pixel);
    if (patch == nullptr) return;
    __builtin_prefetch(patch);
    // A patch may lie on two lines.
    __builtin_prefetch(&patch->relative_noise);
#endif
  }

 private:
  // Returns the patch nearest to a pixel, valid or not, or null outside of the picture.
  const SurfacePatch* At(const Eigen::Vector2d& pixel) const {
    // This test precedes the cast, which is undefined for values outside the range of int.
    if (!(pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < camera_.width - 0.5 &&
          pixel.y() < camera_.height - 0.5)) {
      return nullptr;
    }
    return &patches_(NearestPixel(pixel.x()) / cell_, NearestPixel(pixel.y()) / cell_);
  }
  // Takes the noise from a model in the unit of the surface.
  void UseModel(const DepthNoise& model);

  PinholeCamera camera_;
  ObservedSurfaceOptions options_;
  int cell_;
  int num_valid_ = 0;
  double noise_ = 0.0;
  double median_depth_ = 0.0;
  double slope_noise_ = 0.0;
  Image<SurfacePatch> patches_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_OBSERVED_SURFACE_H_
