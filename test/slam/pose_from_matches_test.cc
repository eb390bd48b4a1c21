#include "ceres_ed/slam/frame/pose_from_matches.h"

#include <ceres_ed/util/random.h>

#include <gtest/gtest.h>
#include <test/slam/depth_scenes.h>

namespace ceres_ed {
namespace {

Eigen::Vector3d Somewhere(Random* random) {
  return {8.0 * random->Uniform() - 4.0, 8.0 * random->Uniform() - 4.0, 2.0 * random->Uniform()};
}

// 30 of 100 matches are right.
std::vector<PointMatch> MostlyWrong(const CameraPose& truth) {
  Random random(3);
  std::vector<PointMatch> matches;
  for (int k = 0; k < 100; ++k) {
    PointMatch match;
    match.in_map = Somewhere(&random);
    match.in_camera = truth * (k % 10 < 3 ? match.in_map : Somewhere(&random));
    matches.push_back(match);
  }
  return matches;
}

TEST(PoseFromMatches, IsFoundAmongWrongMatches) {
  const CameraPose truth = Motion(2.1, {0.3, 1.0, -0.5}, {1.0, -2.0, 9.0});
  const std::optional<CameraPose> pose = PoseFromMatches(MostlyWrong(truth), 0.1, 20);
  ASSERT_TRUE(pose.has_value());
  // A wrong match may agree by chance, to within the tolerance.
  EXPECT_LT(pose->rotation.angularDistance(truth.rotation), 0.01);
  EXPECT_LT((pose->translation - truth.translation).norm(), 0.05);
}

TEST(PoseFromMatches, NeedsEnoughThatAgree) {
  const CameraPose truth = Motion(2.1, {0.3, 1.0, -0.5}, {1.0, -2.0, 9.0});
  EXPECT_FALSE(PoseFromMatches(MostlyWrong(truth), 0.1, 60).has_value());
  EXPECT_FALSE(PoseFromMatches({}, 0.1, 3).has_value());
  // Matches at one place determine no rotation.
  EXPECT_FALSE(PoseFromMatches(std::vector<PointMatch>(50), 0.1, 10).has_value());
}

}  // namespace
}  // namespace ceres_ed
