#include "ceres_ed/pipeline/fit/named_landmarks.h"

#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A tetrahedron far from the axis about which LPS and RAS differ.
PointCloud Tetrahedron() {
  PointCloud cloud;
  cloud.points = {{10, 20, 0}, {12, 20, 0}, {10, 22, 0}, {10, 20, 2}};
  cloud.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return cloud;
}

class NamedLandmarkFiles : public ::testing::Test {
 protected:
  StatusOr<NamedLandmarks> LoadPairs(const std::string& source, const std::string& target) {
    WriteBytes(directory_ / "s.csv", source);
    WriteBytes(directory_ / "t.csv", target);
    FitSettings settings;
    settings.source_landmarks = directory_ / "s.csv";
    settings.target_landmarks = directory_ / "t.csv";
    const PointCloud cloud = Tetrahedron();
    const PlyDocument document;
    return LoadNamedLandmarks(settings, {cloud, document}, {cloud, document});
  }
  TemporaryDirectory directory_;
};

TEST_F(NamedLandmarkFiles, AreMatchedByName) {
  const auto named = LoadPairs("a,10,20,0\nb,12,20,0\nc,10,22,0", "c,1,2,3\nd,11,20,0\na,12,20,0");
  ASSERT_TRUE(named.ok()) << named.status().message();
  ASSERT_EQ(named->pairs.size(), 2U);
  EXPECT_EQ(named->pairs[0].name, "a");
  EXPECT_EQ(named->pairs[0].target, Eigen::Vector3d(12, 20, 0));
  EXPECT_EQ(named->pairs[1].name, "c");
  EXPECT_THAT(named->only_source, ElementsAre("b"));
  EXPECT_THAT(named->only_target, ElementsAre("d"));
}

TEST_F(NamedLandmarkFiles, ThoseOfRasAreTurnedAndThoseThatSeemToBeAreNamed) {
  const std::string here = "label,l,p,s\na,10,20,0\nb,12,20,0\n";
  const auto good = LoadPairs(here, "label,r,a,s\na,-10,-20,0\nb,-12,-20,0\n");
  ASSERT_TRUE(good.ok()) << good.status().message();
  EXPECT_THAT(good->warnings, IsEmpty());
  EXPECT_EQ(good->pairs[1].target, Eigen::Vector3d(12, 20, 0));
  const auto turned = LoadPairs(here, "label,l,p,s\na,-10,-20,0\nb,-12,-20,0\n");
  ASSERT_TRUE(turned.ok()) << turned.status().message();
  EXPECT_THAT(turned->warnings, ElementsAre(HasSubstr("and close with x and y turned")));
  const auto far = LoadPairs(here, "a,100,200,0\nb,120,200,0\n");
  ASSERT_TRUE(far.ok()) << far.status().message();
  EXPECT_THAT(far->warnings, ElementsAre(HasSubstr("do both have the same frame and unit?")));
}

TEST(LandmarkConstraints, BringALandmarkBesideItsVerticesToItsTarget) {
  const PointCloud cloud = Tetrahedron();
  Similarity motion;
  motion.scale = 1.5;
  motion.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 1, 1).normalized());
  motion.translation = {-3, 4, 5};
  std::vector<LandmarkPair> pairs;
  for (const Eigen::Vector3d& at :
       {Eigen::Vector3d(10.3, 20.2, -0.1), {10.1, 20.9, 1.2}, {11, 21, 1.5}, {9, 21, 0.5}}) {
    pairs.push_back({std::to_string(pairs.size()), at, motion * at});
  }
  const std::vector<Landmark> constraints = LandmarkConstraints(pairs, cloud);
  // Every vertex once, and where the motion takes it.
  ASSERT_EQ(constraints.size(), 4U);
  for (const Landmark& constraint : constraints) {
    EXPECT_LT((constraint.position - motion * cloud.points[constraint.point]).norm(), 1e-12);
  }
}

TEST(LandmarkConstraints, OfTwoPairsDrawTheNearestVertices) {
  const PointCloud cloud = Tetrahedron();
  const std::vector<Landmark> constraints = LandmarkConstraints(
      {{"a", {10.1, 20, 0}, {1, 2, 3}}, {"b", {12.1, 20, 0}, {4, 5, 6}}}, cloud);
  ASSERT_EQ(constraints.size(), 2U);
  EXPECT_EQ(constraints[0].point, 0);
  EXPECT_EQ(constraints[0].position, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(constraints[1].point, 1);
}

}  // namespace
}  // namespace ceres_ed
