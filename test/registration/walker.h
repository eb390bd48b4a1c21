// A body with four legs, a neck and a tail, in closed-form poses: large articulated motion whose
// truth is known.
#ifndef CERES_ED_TEST_REGISTRATION_WALKER_H_
#define CERES_ED_TEST_REGISTRATION_WALKER_H_

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/simulation/meshing.h>
#include <ceres_ed/simulation/solid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ceres_ed {

// The joints of a walker, in radians; all 0 is at rest.
struct WalkerPose {
  // How far each leg swings toward the tail: front left, front right, hind left, hind right.
  std::array<double, 4> legs = {0.0, 0.0, 0.0, 0.0};
  // How far each leg swings to the right before that.
  std::array<double, 4> aside = {0.0, 0.0, 0.0, 0.0};
  // How far the neck turns to the left.
  double neck = 0.0;
};

inline constexpr double kWalkerHipX = 0.22;
inline constexpr double kWalkerHipY = 0.07;
inline constexpr double kWalkerHipZ = -0.09;

// Returns the walker at rest with about `vertices` vertices. It is about 1 long, looks toward +x,
// and is symmetric to the plane y = 0.
inline PointCloud MakeWalker(int vertices) {
  SyntheticSolid solid(0.03);
  solid.Add({{{-0.30, 0, 0, 0.075}, {0.00, 0, 0, 0.090}, {0.30, 0, 0, 0.085}}});
  solid.Add({{{0.30, 0, 0.03, 0.055}, {0.40, 0, 0.13, 0.045}, {0.48, 0, 0.16, 0.050}}});
  solid.Add({{{-0.32, 0, 0.03, 0.030}, {-0.45, 0, 0.06, 0.024}, {-0.56, 0, 0.05, 0.020}}});
  for (const double side : {1.0, -1.0}) {
    solid.Add({{{kWalkerHipX, side * 0.06, -0.04, 0.045},
                {kWalkerHipX, side * 0.07, -0.20, 0.034},
                {kWalkerHipX, side * 0.07, -0.36, 0.030}}});
    solid.Add({{{-kWalkerHipX, side * 0.06, -0.04, 0.055},
                {-kWalkerHipX, side * 0.07, -0.20, 0.036},
                {-kWalkerHipX, side * 0.07, -0.33, 0.028}}});
  }
  return RemeshUniformly(MarchTetrahedra(solid, 0.016), solid, vertices);
}

// Returns where a point of the walker at rest comes in `pose`. Joints bend over a tenth of the
// body.
inline Eigen::Vector3d MoveWalkerPoint(const WalkerPose& pose, const Eigen::Vector3d& point) {
  const auto bend = [](double depth) {
    const double s = std::clamp(depth / 0.1, 0.0, 1.0);
    return s * s * (3.0 - 2.0 * s);
  };
  Eigen::Vector3d moved = point;
  if (point.z() < kWalkerHipZ) {
    const int leg = (point.x() < 0.0 ? 2 : 0) + (point.y() < 0.0 ? 1 : 0);
    const Eigen::Vector3d hip(
        std::copysign(kWalkerHipX, point.x()), std::copysign(kWalkerHipY, point.y()), kWalkerHipZ);
    const double share = bend(kWalkerHipZ - point.z());
    const Eigen::AngleAxisd aside(-share * pose.aside[leg], Eigen::Vector3d::UnitX());
    const Eigen::AngleAxisd swing(share * pose.legs[leg], Eigen::Vector3d::UnitY());
    moved = hip + swing * (aside * (point - hip));
  } else if (point.x() > 0.30) {
    const Eigen::Vector3d joint(0.30, 0.0, 0.0);
    const double angle = pose.neck * bend(point.x() - 0.30);
    moved = joint + Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()) * (point - joint);
  }
  return moved;
}

inline PointCloud MoveWalker(const WalkerPose& pose, PointCloud walker) {
  for (Eigen::Vector3d& point : walker.points) point = MoveWalkerPoint(pose, point);
  walker.normals.clear();
  return walker;
}

// Returns the mean distance between two clouds of the same points, in percent of the diagonal of
// the second.
inline double MeanErrorPercent(const std::vector<Eigen::Vector3d>& points,
                               const PointCloud& truth) {
  double sum = 0.0;
  for (std::size_t p = 0; p < points.size(); ++p) sum += (points[p] - truth.points[p]).norm();
  const Eigen::AlignedBox3d box = BoundingBox(truth.points);
  return 100.0 * sum / points.size() / box.diagonal().norm();
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_REGISTRATION_WALKER_H_
