#include "ceres_ed/slam/frame/association.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/slam/depth_scenes.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// The rounding of the depth image's floats at a distance of about 6.
constexpr double kBound = 6.0 * 10.0 * kFloatRounding;

class AssociatePlane : public ::testing::Test {
 protected:
  // Adds a point whose foot on the plane is at pixel (u, v), at the distance `offset` from the
  // plane toward the camera, with a normal that is rotated by `turn_deg` from that of the plane.
  void Add(double u, double v, double offset, double turn_deg = 0.0) {
    const Eigen::Vector3d ray = SmallCamera().BackProject(u, v, 1.0);
    const Eigen::Vector3d foot = plane_(ray) * ray;
    const Eigen::Vector3d axis = plane_.normal.unitOrthogonal();
    const Eigen::Vector3d normal = Eigen::AngleAxisd(turn_deg * M_PI / 180.0, axis) * plane_.normal;
    points_.push_back(MakeVisible(SmallCamera(), pose_, foot + offset * plane_.normal, normal));
  }

  AssociationResult Run(const AssociationOptions& options = {}) const {
    return Associate(points_, pose_, surface_, options);
  }

  const PlaneScene plane_ = TiltedPlane(6.0, 35.0, 20.0);
  const CameraPose pose_ = Motion(0.8, {1.0, -2.0, 0.3}, {1.0, 2.0, -3.0});
  const ObservedSurface surface_{
      RenderDepth(SmallCamera(), plane_), SmallCamera(), 1.0, ObservedSurfaceOptions()};
  std::vector<VisiblePoint> points_;
};

TEST_F(AssociatePlane, MeasuresTheDistanceToThePlaneWithItsSign) {
  const std::vector<double> offsets = {0.0, 0.4, -0.4, 0.99, -0.99, 1e-3};
  for (std::size_t k = 0; k < offsets.size(); ++k) Add(40.3 + 10.0 * k, 60.2, offsets[k]);
  const AssociationResult result = Run();
  ASSERT_EQ(result.matches.size(), offsets.size());
  EXPECT_EQ(result.measured, 6);
  for (std::size_t k = 0; k < offsets.size(); ++k) {
    const Association& match = result.matches[k];
    EXPECT_EQ(match.visible, static_cast<int>(k));
    EXPECT_NEAR(match.distance, offsets[k], kBound);
    EXPECT_EQ(match.patch, surface_.Find(points_[k].pixel));
    // The cosine of the angle between ray and normal.
    EXPECT_NEAR(match.weight, -plane_.normal.dot(match.patch->point.normalized()), 1e-4);
  }
  EXPECT_THAT(result.seen_through, IsEmpty());
  // In order: 0, 0.001, 0.4, [0.4], 0.99, 0.99.
  EXPECT_NEAR(result.deviation, 1.4826 * 0.4, 2.0 * kBound);
}

TEST_F(AssociatePlane, SeesThroughPointsFarInFrontAlone) {
  Add(50.0, 50.0, 1.01);
  Add(60.0, 50.0, 0.98);
  Add(70.0, 50.0, -1.01);
  Add(80.0, 50.0, 3.0);
  // A point in front is seen through whatever its normal.
  Add(90.0, 50.0, 2.0, 120.0);
  const AssociationResult result = Run();
  EXPECT_THAT(result.seen_through, ElementsAre(0, 3, 4));
  ASSERT_EQ(result.matches.size(), 1u);
  EXPECT_EQ(result.matches[0].visible, 1);
  EXPECT_EQ(result.measured, 5);
  AssociationOptions options;
  options.max_distance = 2.5;
  EXPECT_THAT(Run(options).seen_through, ElementsAre(3));
}

TEST_F(AssociatePlane, RefusesNormalsThatAreTurnedTooFar) {
  Add(50.0, 50.0, 0.1, 59.9);
  Add(60.0, 50.0, 0.1, 60.1);
  Add(70.0, 50.0, 0.1, -60.1);
  Add(80.0, 50.0, 0.1, 180.0);
  AssociationResult result = Run();
  ASSERT_EQ(result.matches.size(), 1u);
  EXPECT_EQ(result.matches[0].visible, 0);
  EXPECT_EQ(result.measured, 4);
  AssociationOptions options;
  options.max_angle_deg = 180.0;
  EXPECT_EQ(Run(options).matches.size(), 4u);
}

TEST_F(AssociatePlane, PassesOverPixelsWithoutAPatch) {
  DepthImage depth = RenderDepth(SmallCamera(), plane_);
  depth(51, 51) = 0.0F;
  Add(51.0, 51.0, 0.0);
  Add(71.0, 51.0, 0.0);
  points_.push_back(points_.back());
  points_.back().pixel = {-7.0, 20.0};
  const ObservedSurface surface(depth, SmallCamera(), 1.0, ObservedSurfaceOptions());
  const AssociationResult result = Associate(points_, pose_, surface, AssociationOptions());
  EXPECT_EQ(result.measured, 1);
  ASSERT_EQ(result.matches.size(), 1u);
  EXPECT_EQ(result.matches[0].visible, 1);
}

TEST(Associate, WeighsGrazingPatchesLessButNeverNothing) {
  for (const double slope : {0.0, 45.0, 70.0}) {
    const PlaneScene plane = TiltedPlane(6.0, slope, 90.0);
    const ObservedSurface surface(
        RenderDepth(SmallCamera(), plane), SmallCamera(), 1.0, ObservedSurfaceOptions());
    std::vector<VisiblePoint> points;
    for (const double v : {20.0, 60.0, 100.0}) {
      const Eigen::Vector3d ray = SmallCamera().BackProject(80.0, v, 1.0);
      points.push_back(MakeVisible(SmallCamera(), {}, plane(ray) * ray, plane.normal));
    }
    for (const Association& m : Associate(points, {}, surface, {}).matches) {
      const double cosine = -plane.normal.dot(m.patch->point.normalized());
      EXPECT_NEAR(m.weight, std::min(1.0, std::max(0.1, cosine)), 1e-4);
    }
  }
}

}  // namespace
}  // namespace ceres_ed
