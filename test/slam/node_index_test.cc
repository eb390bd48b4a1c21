#include "ceres_ed/slam/map/node_index.h"

#include <ceres_ed/util/random.h>

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

const PinholeCamera kCamera = {90.0, 80.0, 47.0, 33.0, 96, 72};

CameraPose RandomPose(Random* random) {
  CameraPose pose;
  pose.rotation =
      Eigen::Quaterniond(
          random->Gaussian(), random->Gaussian(), random->Gaussian(), random->Gaussian())
          .normalized();
  for (int axis = 0; axis < 3; ++axis) pose.translation[axis] = 30.0 * random->Gaussian();
  return pose;
}

Eigen::Vector3d RandomPlace(double size, Random* random) {
  return size * Eigen::Vector3d(random->Gaussian(), random->Gaussian(), random->Gaussian());
}

bool IsInPicture(const CameraPose& pose, const Eigen::Vector3d& point) {
  const Eigen::Vector3d x = pose * point;
  if (x.z() <= 0.0) return false;
  const Eigen::Vector2d pixel = kCamera.Project(x);
  return pixel.x() >= -0.5 && pixel.x() < kCamera.width - 0.5 && pixel.y() >= -0.5 &&
         pixel.y() < kCamera.height - 0.5;
}

TEST(ViewVolume, TouchesEveryBallWithAPointInThePicture) {
  Random random(1);
  int inside = 0;
  int refused = 0;
  for (int k = 0; k < 20000; ++k) {
    const CameraPose pose = RandomPose(&random);
    const ViewVolume view(pose, kCamera);
    const Eigen::Vector3d point = RandomPlace(60.0, &random);
    const Eigen::Vector3d direction = RandomPlace(1.0, &random).normalized();
    if (IsInPicture(pose, point)) {
      ++inside;
      EXPECT_TRUE(view.MayTouch(point, 0.0));
      EXPECT_TRUE(view.MayTouch(point + 2.999 * direction, 3.0));
    } else {
      // A point is a ball without radius: a point outside the picture is outside the volume.
      EXPECT_FALSE(view.MayTouch(point, -1e-9));
      ++refused;
    }
  }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(refused, 1000);
}

// Compares with a test of every node. Cells are up to 4 wide, so nodes that are farther away by up
// to their diagonal may be included.
TEST(NodeIndex, FindsWhatALookAtEveryNodeFinds) {
  Random random(2);
  NodeIndex index;
  std::vector<Eigen::Vector3d> places;
  for (int j = 0; j < 3000; ++j) {
    places.push_back(RandomPlace(100.0, &random));
    index.Place(j, places.back());
  }
  for (int round = 0; round < 50; ++round) {
    // Some nodes move, by large or small distances.
    for (int k = 0; k < 100; ++k) {
      const int node = (round * 7919 + k * 104729) % 3000;
      places[node] += RandomPlace(k % 2 == 0 ? 0.1 : 50.0, &random);
      index.Place(node, places[node]);
    }
    const CameraPose pose = RandomPose(&random);
    const ViewVolume view(pose, kCamera);
    const std::vector<int> found = index.NearView(view, 3.0);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    EXPECT_TRUE(std::adjacent_find(found.begin(), found.end()) == found.end());
    for (int j = 0; j < 3000; ++j) {
      const bool is_found = std::binary_search(found.begin(), found.end(), j);
      if (view.MayTouch(places[j], 3.0)) EXPECT_TRUE(is_found) << j;
      if (is_found) EXPECT_TRUE(view.MayTouch(places[j], 3.0 + 4.0 * std::sqrt(3.0))) << j;
    }
  }
}

}  // namespace
}  // namespace ceres_ed
