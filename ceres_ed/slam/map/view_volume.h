// The part of space that a picture may show.
#ifndef CERES_ED_SLAM_MAP_VIEW_VOLUME_H_
#define CERES_ED_SLAM_MAP_VIEW_VOLUME_H_

#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/graph/deformation_state.h>

#include <array>

#include <Eigen/Core>

namespace ceres_ed {

// The pyramid of the rays through the picture, in front of the camera, in the map frame.
class ViewVolume {
 public:
  ViewVolume(const CameraPose& camera_from_map, const PinholeCamera& camera);

  // Returns whether a ball may intersect the volume. The result is true for every ball that does,
  // and for few others near the edges of the pyramid. If it is true for a ball, it is true for
  // every ball that contains it.
  bool MayTouch(const Eigen::Vector3d& center, double radius) const {
    for (const Plane& plane : planes_) {
      if (plane.normal.dot(center) + plane.offset < -radius) return false;
    }
    return true;
  }

 private:
  // normal . x + offset >= 0 inside the volume; the normals have unit length.
  struct Plane {
    Eigen::Vector3d normal;
    double offset;
  };
  std::array<Plane, 5> planes_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_MAP_VIEW_VOLUME_H_
