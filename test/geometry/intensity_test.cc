#include "ceres_ed/geometry/intensity.h"

#include <ceres_ed/geometry/normals.h>

#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const Eigen::Vector3d kSlope(0.3, -0.2, 0.1);

// Returns a brightness that is linear in space.
double Brightness(const Eigen::Vector3d& point) { return 0.5 + kSlope.dot(point); }

// Returns points on a tilted plane, with some scatter along it.
PointCloud TiltedSheet(int side, bool with_triangles) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  const Eigen::Quaterniond tilt(
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, -0.5).normalized()));
  PointCloud sheet;
  for (int r = 0; r < side; ++r) {
    for (int c = 0; c < side; ++c) {
      sheet.points.push_back(tilt * Eigen::Vector3d(c + jitter(random), r + jitter(random), 0.0) /
                             side);
    }
  }
  for (int r = 0; with_triangles && r + 1 < side; ++r) {
    for (int c = 0; c + 1 < side; ++c) {
      const int a = r * side + c;
      sheet.triangles.push_back({a, a + 1, a + side});
      sheet.triangles.push_back({a + 1, a + side + 1, a + side});
    }
  }
  sheet.normals.assign(sheet.size(), tilt * Eigen::Vector3d::UnitZ());
  for (const Eigen::Vector3d& point : sheet.points) {
    sheet.intensities.push_back(Brightness(point));
  }
  return sheet;
}

// Returns the component of a gradient that lies in the plane.
Eigen::Vector3d Along(const Eigen::Vector3d& normal, const Eigen::Vector3d& gradient) {
  return gradient - normal * normal.dot(gradient);
}

TEST(GradientOnTriangle, IsThatOfALinearFieldInThePlane) {
  const Eigen::Vector3d a(0.1, 0.2, 0.3);
  const Eigen::Vector3d b(1.0, 0.1, -0.4);
  const Eigen::Vector3d c(0.3, 2.0, 0.8);
  const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
  const Eigen::Vector3d gradient =
      GradientOnTriangle(a, b, c, {Brightness(a), Brightness(b), Brightness(c)});
  EXPECT_LT((gradient - Along(normal, kSlope)).norm(), 1e-14);
}

TEST(GradientOnTriangle, IsUnknownWithoutAreaOrWithoutAValue) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  EXPECT_FALSE(GradientOnTriangle(zero, x, 2.0 * x, {0.1, 0.2, 0.3}).allFinite());
  EXPECT_FALSE(GradientOnTriangle(x, x, x, {0.1, 0.2, 0.3}).allFinite());
  EXPECT_FALSE(GradientOnTriangle(zero, x, y, {0.1, kNaN, 0.3}).allFinite());
}

TEST(IntensityGradients, AreThoseOfALinearFieldAlongMeshesAndBarePoints) {
  for (const bool with_triangles : {true, false}) {
    const PointCloud sheet = TiltedSheet(12, with_triangles);
    const std::vector<Eigen::Vector3d> gradients = IntensityGradients(sheet);
    ASSERT_EQ(gradients.size(), sheet.size());
    for (const Eigen::Vector3d& gradient : gradients) {
      EXPECT_LT((gradient - Along(sheet.normals[0], kSlope)).norm(), 1e-12);
    }
  }
}

TEST(IntensityGradients, LeaveOutWhatIsUnknown) {
  for (const bool with_triangles : {true, false}) {
    PointCloud sheet = TiltedSheet(12, with_triangles);
    sheet.intensities[5 * 12 + 5] = kNaN;
    const std::vector<Eigen::Vector3d> gradients = IntensityGradients(sheet);
    for (int p = 0; p < static_cast<int>(sheet.size()); ++p) {
      if (p == 5 * 12 + 5) {
        EXPECT_FALSE(gradients[p].allFinite());
      } else {
        EXPECT_LT((gradients[p] - Along(sheet.normals[0], kSlope)).norm(), 1e-12);
      }
    }
  }
}

TEST(IntensityGradients, AreUnknownWherePointsLieOnALine) {
  PointCloud line;
  for (int i = 0; i < 20; ++i) {
    line.points.emplace_back(0.1 * i, 0.0, 0.0);
    line.normals.push_back(Eigen::Vector3d::UnitZ());
    line.intensities.push_back(0.05 * i);
  }
  for (const Eigen::Vector3d& gradient : IntensityGradients(line)) {
    EXPECT_FALSE(gradient.allFinite());
  }
}

}  // namespace
}  // namespace ceres_ed
