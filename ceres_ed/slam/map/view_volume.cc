#include "ceres_ed/slam/map/view_volume.h"

namespace ceres_ed {

ViewVolume::ViewVolume(const CameraPose& camera_from_map, const PinholeCamera& camera) {
  // Pixels extend half a pixel beyond their centres: -0.5 <= fx x / z + cx < width - 0.5.
  const Eigen::Vector3d normals[] = {{0.0, 0.0, 1.0},
                                     {camera.fx, 0.0, camera.cx + 0.5},
                                     {-camera.fx, 0.0, camera.width - 0.5 - camera.cx},
                                     {0.0, camera.fy, camera.cy + 0.5},
                                     {0.0, -camera.fy, camera.height - 0.5 - camera.cy}};
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    const Eigen::Vector3d normal = normals[i].normalized();
    planes_[i] = {camera_from_map.rotation.conjugate() * normal,
                  normal.dot(camera_from_map.translation)};
  }
}

}  // namespace ceres_ed
