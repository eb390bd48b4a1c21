// The part of space that a picture may show.
#ifndef CERES_ED_SLAM_MAP_VIEW_VOLUME_H_
#define CERES_ED_SLAM_MAP_VIEW_VOLUME_H_

#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/graph/deformation_state.h>

#include <array>

#include <Eigen/Core>

namespace ceres_ed {

// The pyramid behind the borders of the picture, before the camera, in the map's frame.
class ViewVolume {
 public:
  ViewVolume(const CameraPose& camera_from_map, const PinholeCamera& camera);

  // Whether a ball may reach into it: true for every ball that does, and for few others, beside
  // its edges. True for a ball that holds such a ball.
  bool MayTouch(const Eigen::Vector3d& center, double radius) const {
    for (const Plane& plane : planes_) {
      if (plane.normal.dot(center) + plane.offset < -radius) return false;
    }
    return true;
  }

 private:
  // normal . x + offset >= 0 inside; unit normals.
  struct Plane {
    Eigen::Vector3d normal;
    double offset;
  };
  std::array<Plane, 5> planes_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_MAP_VIEW_VOLUME_H_
