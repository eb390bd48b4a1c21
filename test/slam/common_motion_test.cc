#include "ceres_ed/slam/levels/common_motion.h"

#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <cost_functions/node_parameters.h>
#include <gtest/gtest.h>
#include <test/slam/level_scenes.h>

namespace ceres_ed {
namespace {

std::vector<Eigen::Vector3d> Translations(const DeformableMap& map) {
  std::vector<Eigen::Vector3d> translations;
  for (int j = 0; j < map.state().num_nodes(); ++j) {
    translations.push_back(NodeTranslation(map.state().node(j)));
  }
  return translations;
}

TEST(CommonMotion, IsNothingWhereTheTissueKeepsStill) {
  const LevelScene scene;
  EXPECT_TRUE(
      CommonMotionCovariance(scene.observations, Translations(scene.map), scene.map).isZero(1e-20));
  EXPECT_TRUE(CommonMotionCovariance({}, {}, scene.map).isZero(0.0));
}

// Every node moves by the same step s: the place of the tissue is as uncertain, whatever the
// camera.
TEST(CommonMotion, MovesTheCameraWithTheTissueAndTurnsItAboutIt) {
  LevelScene scene;
  const std::vector<Eigen::Vector3d> before = Translations(scene.map);
  const Eigen::Vector3d step(0.03, 0.0, 0.04);
  for (std::size_t j = 0; j < before.size(); ++j) {
    SetTranslation(&scene.map, static_cast<int>(j), before[j] + step);
  }
  const Eigen::Matrix<double, 6, 6> covariance =
      CommonMotionCovariance(scene.observations, before, scene.map);
  const double s = kCommonMotionScale * step.norm();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  const auto& planes = scene.observations.planes;
  for (const MapObservation& o : planes) center += o.target / static_cast<double>(planes.size());
  double square_radius = 0.0;
  for (const MapObservation& o : planes) {
    square_radius += (o.target - center).squaredNorm() / static_cast<double>(planes.size());
  }
  const Eigen::Matrix3d turn = covariance.bottomRightCorner<3, 3>();
  EXPECT_TRUE(turn.isApprox(s * s / square_radius * Eigen::Matrix3d::Identity(), 1e-9));
  // The centre of the tissue, as the camera has it in the map, is uncertain by s in each direction:
  // x = t + R c, so that dx = dt - R [c] dw.
  const Eigen::Matrix3d rotation =
      scene.map.state().camera_from_map.rotation.conjugate().toRotationMatrix();
  Eigen::Matrix3d cross;
  for (int i = 0; i < 3; ++i) cross.col(i) = center.cross(Eigen::Vector3d::Unit(i));
  Eigen::Matrix<double, 3, 6> of_center;
  of_center << Eigen::Matrix3d::Identity(), -rotation * cross;
  const Eigen::Matrix3d place = of_center * covariance * of_center.transpose();
  EXPECT_TRUE(place.isApprox(s * s * Eigen::Matrix3d::Identity(), 1e-9));
}

}  // namespace
}  // namespace ceres_ed
