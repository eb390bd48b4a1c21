#include <ceres_ed/registration/normal_spread.h>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

TEST(NormalSpread, IsAThirdForASphereAndNothingForASheet) {
  EXPECT_NEAR(LeastNormalSpread(Surface(MakeSphereMesh(3))), 1.0 / 3.0, 1e-3);
  EXPECT_NEAR(LeastNormalSpread(Surface(MakeGridMesh(20, 30))), 0.0, 1e-12);
}

// The walls of a tube have n = (cos a, sin a, 0): nothing holds it along its axis.
TEST(NormalSpread, IsNothingAlongATube) {
  PointCloud tube = MakeGridMesh(61, 20);
  for (Eigen::Vector3d& point : tube.points) {
    const double angle = 2.0 * M_PI * point.x() / 60.0;
    point = {std::cos(angle), std::sin(angle), 0.1 * point.y()};
  }
  EXPECT_NEAR(LeastNormalSpread(Surface(tube)), 0.0, 1e-12);
}

}  // namespace
}  // namespace ceres_ed
