// Pictures of planes as two cameras see them, by the closed form of projection.
#ifndef CERES_ED_TEST_STEREO_STEREO_SCENES_H_
#define CERES_ED_TEST_STEREO_STEREO_SCENES_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/stereo_rig.h>
#include <ceres_ed/io/sequence/layouts/stereo_file.h>
#include <ceres_ed/simulation/texture.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ceres_ed {

// The part of the plane normal . x = distance (in the frame of the left camera, metres) with
// first <= x <= last.
struct TexturedPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double distance = 0.06;
  double first = -std::numeric_limits<double>::infinity();
  double last = std::numeric_limits<double>::infinity();
};

// Returns the nearest depth along the ray, along the z axis of the left camera, and the point.
inline bool Hit(const std::vector<TexturedPlane>& planes,
                const Eigen::Vector3d& start,
                const Eigen::Vector3d& ray,
                Eigen::Vector3d* point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const TexturedPlane& plane : planes) {
    const double t = (plane.distance - plane.normal.dot(start)) / plane.normal.dot(ray);
    const Eigen::Vector3d hit = start + t * ray;
    if (t <= 0.0 || t >= nearest || hit.x() < plane.first || hit.x() > plane.last) continue;
    nearest = t;
    *point = hit;
  }
  return std::isfinite(nearest);
}

// Returns the picture of the planes through a camera without distortion; black where there is none.
// `camera_from_left` is the pose of the camera.
inline ColorImage Photograph(const std::vector<TexturedPlane>& planes,
                             const PinholeCamera& camera,
                             const RigidTransform& camera_from_left) {
  const SyntheticTexture texture(3);
  const RigidTransform left_from_camera = camera_from_left.Inverse();
  ColorImage picture(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray = left_from_camera.rotation * camera.BackProject(u, v, 1.0);
      Eigen::Vector3d point;
      if (!Hit(planes, left_from_camera.translation, ray, &point)) continue;
      const Eigen::Vector3d color = texture.Color(point, point.z() / camera.fx);
      for (int channel = 0; channel < 3; ++channel) {
        const double level = std::round(230.0 * color[channel]);
        picture(u, v)[channel] = static_cast<std::uint8_t>(std::clamp(level, 0.0, 230.0));
      }
    }
  }
  return picture;
}

// A rectified stereo endoscope of 320 x 240 pixels, 5 mm wide. Principal points differ by 3 pixels.
inline StereoRig RectifiedTestRig() {
  return MakeRectifiedRig({280.0, 280.0, 160.0, 119.5, 320, 240}, 157.0, 0.005);
}

// A stereo endoscope whose right camera is turned.
inline StereoRig TurnedTestRig() {
  StereoRig rig = RectifiedTestRig();
  rig.right.pinhole.fx = 284.0;
  rig.right.pinhole.fy = 284.0;
  rig.right.pinhole.cy = 115.0;
  rig.right_from_left.rotation =
      Eigen::AngleAxisd(0.04, Eigen::Vector3d(0.5, 0.6, -0.6).normalized());
  rig.right_from_left.translation = {-0.005, 0.0003, -0.0002};
  return rig;
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_STEREO_STEREO_SCENES_H_
