#include "ceres_ed/report/view/view_camera.h"

#include <ceres_ed/report/view/scene.h>

#include <array>
#include <cmath>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

// Returns the mean of the normals of all triangles, weighted by area; its length is in [0, 1].
Eigen::Vector3d MeanNormal(const ViewSurface& surface) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0.0;
  for (const std::array<int, 3>& t : surface.triangles) {
    const Eigen::Vector3d& a = surface.points[t[0]];
    const Eigen::Vector3d normal = (surface.points[t[1]] - a).cross(surface.points[t[2]] - a);
    sum += normal;
    area += normal.norm();
  }
  if (!(area > 0.0)) return Eigen::Vector3d::Zero();
  return sum / area;
}

}  // namespace

ViewCamera ChooseCamera(const Scene& scene) {
  if (scene.camera) return *scene.camera;
  constexpr double kOneSided = 0.3;
  constexpr double kSteep = 0.9;
  constexpr double kAside = 50.0 * M_PI / 180.0;
  bool is_one_sided = false;
  ViewCamera camera;
  camera.from = Eigen::Vector3d(0.45, 0.35, 1.0).normalized();
  for (const ViewSurface& surface : scene.surfaces) {
    if (surface.motion) continue;
    const Eigen::Vector3d normal = MeanNormal(surface);
    if (normal.norm() > kOneSided) {
      camera.from = normal.normalized();
      is_one_sided = true;
      break;
    }
  }
  if (std::abs(camera.from.y()) > kSteep) camera.up = Eigen::Vector3d::UnitZ();
  if (is_one_sided) camera.from = Eigen::AngleAxisd(kAside, camera.up) * camera.from;
  return camera;
}

}  // namespace ceres_ed
