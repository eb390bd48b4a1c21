#include "ceres_ed/slam/levels/common_motion.h"

#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <cost_functions/node_parameters.h>
#include <gtest/gtest.h>
#include <test/slam/level_scenes.h>

namespace ceres_ed {
namespace {

NodePlaces PlacesOf(const LevelScene& scene) {
  std::vector<PointBinding> bindings;
  for (const MapObservation& o : scene.observations.planes) bindings.push_back(o.binding);
  NodePlaces places;
  places.Take(bindings, scene.map.state());
  return places;
}

Eigen::Matrix<double, 6, 6> CovarianceOf(const LevelScene& scene, const NodePlaces& before) {
  return CommonMotionCovariance(scene.observations, before, scene.map.state());
}

TEST(CommonMotion, IsNothingWhereTheTissueKeepsStill) {
  const LevelScene scene;
  const NodePlaces before = PlacesOf(scene);
  EXPECT_TRUE(CovarianceOf(scene, before).isZero(1e-20));
  EXPECT_TRUE(CommonMotionCovariance({}, before, scene.map.state()).isZero(0.0));
}

TEST(CommonMotion, KnowsTheNodesOfTheBindingsAlone) {
  const LevelScene scene;
  const NodePlaces places = PlacesOf(scene);
  const int last = scene.map.state().num_nodes() - 1;
  EXPECT_EQ(places.Find(last), nullptr);
  const int seen = scene.observations.planes.front().binding.nodes[0];
  ASSERT_NE(places.Find(seen), nullptr);
  EXPECT_EQ(*places.Find(seen), NodeTranslation(scene.map.state().node(seen)));
}

// Every node moves by the same step s: the place and the turn of the tissue are as uncertain as
// their scales say, whatever the camera.
TEST(CommonMotion, MovesTheCameraWithTheTissueAndTurnsItAboutIt) {
  LevelScene scene;
  const NodePlaces before = PlacesOf(scene);
  const Eigen::Vector3d step(0.03, 0.0, 0.04);
  for (int j = 0; j < scene.map.state().num_nodes(); ++j) {
    SetTranslation(&scene.map, j, NodeTranslation(scene.map.state().node(j)) + step);
  }
  const Eigen::Matrix<double, 6, 6> covariance = CovarianceOf(scene, before);
  const double s = step.norm();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  const auto& planes = scene.observations.planes;
  for (const MapObservation& o : planes) center += o.target / static_cast<double>(planes.size());
  double square_radius = 0.0;
  for (const MapObservation& o : planes) {
    square_radius += (o.target - center).squaredNorm() / static_cast<double>(planes.size());
  }
  const Eigen::Matrix3d turn = covariance.bottomRightCorner<3, 3>();
  const double square_turn = kCommonTurnScale * kCommonTurnScale * s * s / square_radius;
  EXPECT_TRUE(turn.isApprox(square_turn * Eigen::Matrix3d::Identity(), 1e-9));
  // The centre of the tissue, as the camera has it in the map, is as uncertain in each direction:
  // x = t + R c, so that dx = dt - R [c] dw.
  const Eigen::Matrix3d rotation =
      scene.map.state().camera_from_map.rotation.conjugate().toRotationMatrix();
  Eigen::Matrix3d cross;
  for (int i = 0; i < 3; ++i) cross.col(i) = center.cross(Eigen::Vector3d::Unit(i));
  Eigen::Matrix<double, 3, 6> of_center;
  of_center << Eigen::Matrix3d::Identity(), -rotation * cross;
  const Eigen::Matrix3d place = of_center * covariance * of_center.transpose();
  const double square_place = kCommonPlaceScale * kCommonPlaceScale * s * s;
  EXPECT_TRUE(place.isApprox(square_place * Eigen::Matrix3d::Identity(), 1e-9));
}

}  // namespace
}  // namespace ceres_ed
