#include "ceres_ed/geometry/pinhole_camera.h"

#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

PinholeCamera ExampleCamera() { return {500.0, 400.0, 319.5, 239.5, 640, 480}; }

TEST(PinholeCamera, ProjectsByTheFormula) {
  // u = 500 (0.2 / 2) + 319.5 and v = 400 (-0.1 / 2) + 239.5: x points to the right and y down.
  const Eigen::Vector2d pixel = ExampleCamera().Project({0.2, -0.1, 2.0});
  EXPECT_DOUBLE_EQ(pixel.x(), 369.5);
  EXPECT_DOUBLE_EQ(pixel.y(), 219.5);
  EXPECT_EQ(ExampleCamera().Project({0.0, 0.0, 7.0}), Eigen::Vector2d(319.5, 239.5));
}

TEST(PinholeCamera, BackProjectsToTheDepthAlongTheAxis) {
  const PinholeCamera camera = ExampleCamera();
  EXPECT_EQ(camera.BackProject(319.5, 239.5, 3.0), Eigen::Vector3d(0.0, 0.0, 3.0));
  EXPECT_LT((camera.BackProject(369.5, 219.5, 2.0) - Eigen::Vector3d(0.2, -0.1, 2.0)).norm(),
            1e-15);
  for (const double u : {0.0, 17.25, 639.0}) {
    for (const double depth : {1e-3, 0.3, 50.0}) {
      const Eigen::Vector3d point = camera.BackProject(u, 0.5 * u, depth);
      EXPECT_EQ(point.z(), depth);
      EXPECT_LT((camera.Project(point) - Eigen::Vector2d(u, 0.5 * u)).norm(), 1e-11);
    }
  }
}

TEST(PinholeCamera, SaysWhatIsWrongWithIt) {
  std::string error;
  EXPECT_TRUE(ExampleCamera().IsValid(&error));
  EXPECT_THAT(error, IsEmpty());
  const auto expect_refused = [](const PinholeCamera& camera, const std::string& message) {
    std::string error;
    EXPECT_FALSE(camera.IsValid(&error));
    EXPECT_THAT(error, HasSubstr(message));
  };
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -500.0, inf, std::nan("")}) {
    PinholeCamera camera = ExampleCamera();
    camera.fx = bad;
    expect_refused(camera, "fx is ");
    camera = ExampleCamera();
    camera.fy = bad;
    expect_refused(camera, "fy is ");
  }
  for (const double bad : {inf, -inf, std::nan("")}) {
    PinholeCamera camera = ExampleCamera();
    camera.cx = bad;
    expect_refused(camera, "cx is ");
    camera = ExampleCamera();
    camera.cy = bad;
    expect_refused(camera, "cy is ");
  }
  // A principal point outside of the image means a cropped image, which is valid.
  PinholeCamera camera = ExampleCamera();
  camera.cx = -20.0;
  EXPECT_TRUE(camera.IsValid(&error));
  camera.width = 0;
  expect_refused(camera, "width is 0");
  camera = ExampleCamera();
  camera.height = -1;
  expect_refused(camera, "height is -1");
  expect_refused(PinholeCamera(), "fx is 0");
}

}  // namespace
}  // namespace ceres_ed
