#include "ceres_ed/slam/frame/corner_geometry.h"

#include <algorithm>

namespace ceres_ed {
namespace {

// The least and the largest change of area between a template and the present picture.
constexpr double kLeastArea = 0.25;
constexpr double kMostArea = 4.0;

// Returns how the pixel of a point changes with the point.
Eigen::Matrix<double, 2, 3> PixelFromPoint(const PinholeCamera& camera,
                                           const Eigen::Vector3d& point) {
  const double z = point.z();
  Eigen::Matrix<double, 2, 3> derivative;
  derivative << camera.fx / z, 0.0, -camera.fx * point.x() / (z * z), 0.0, camera.fy / z,
      -camera.fy * point.y() / (z * z);
  return derivative;
}

}  // namespace

CornerPrediction PredictCorner(const Corner& corner,
                               const DeformableMap& map,
                               const CameraPose& camera_from_map,
                               const PinholeCamera& camera) {
  CornerPrediction prediction;
  const LocalWarp warp = map.WarpOf(corner.binding());
  prediction.in_camera = camera_from_map * (warp * corner.at_rest);
  if (!(prediction.in_camera.z() > 0.0)) {
    prediction.pixel = corner.pixel;
    return prediction;
  }
  prediction.pixel = camera.Project(prediction.in_camera);
  prediction.now_from_then =
      PixelFromPoint(camera, prediction.in_camera) *
      (camera_from_map.rotation.toRotationMatrix() * warp.gradient * corner.rest_from_pixel);
  const double area = prediction.now_from_then.determinant();
  prediction.comparable = area >= kLeastArea && area <= kMostArea;
  return prediction;
}

bool OnSurface(const ObservedSurface& surface,
               const Eigen::Vector2d& pixel,
               Eigen::Vector3d* point) {
  const SurfacePatch* patch = surface.Find(pixel);
  if (patch == nullptr) return false;
  const Eigen::Vector3d ray = surface.camera().BackProject(pixel.x(), pixel.y(), 1.0);
  const double along = patch->normal.dot(ray);
  if (!(along < -0.1 * ray.norm())) return false;
  *point = ray * (patch->normal.dot(patch->point) / along);
  return true;
}

Eigen::Matrix<double, 3, 2> PlaneFromPixel(const PinholeCamera& camera,
                                           const Eigen::Vector3d& point,
                                           const Eigen::Vector3d& normal) {
  const Eigen::Vector3d ray = point / point.z();
  Eigen::Matrix<double, 3, 2> derivative;
  derivative << 1.0 / camera.fx, 0.0, 0.0, 1.0 / camera.fy, 0.0, 0.0;
  return point.z() * (derivative - ray * (normal.transpose() * derivative) / normal.dot(ray));
}

MaskImage Measured(const ObservedSurface& surface, int margin) {
  MaskImage measured(surface.camera().width, surface.camera().height, 0);
  for (int v = margin; v < measured.height() - margin; ++v) {
    for (int i = 0; i < surface.width(); ++i) {
      if (!surface.patch(i, v / surface.cell()).valid()) continue;
      const int end = std::min((i + 1) * surface.cell(), measured.width() - margin);
      for (int u = std::max(i * surface.cell(), margin); u < end; ++u) measured(u, v) = 1;
    }
  }
  return measured;
}

}  // namespace ceres_ed
