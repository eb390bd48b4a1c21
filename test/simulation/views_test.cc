#include "ceres_ed/simulation/views.h"

#include <ceres_ed/simulation/meshing.h>
#include <ceres_ed/simulation/shapes.h>
#include <ceres_ed/util/random.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// The test of Moeller and Trumbore: does the segment from `eye` to `point` intersect the triangle?
bool Crosses(const Eigen::Vector3d& eye,
             const Eigen::Vector3d& point,
             const Eigen::Vector3d& a,
             const Eigen::Vector3d& b,
             const Eigen::Vector3d& c) {
  const Eigen::Vector3d direction = point - eye;
  const Eigen::Vector3d p = direction.cross(c - a);
  const double determinant = (b - a).dot(p);
  if (determinant == 0.0) return false;
  const Eigen::Vector3d q = (eye - a).cross(b - a);
  const double u = (eye - a).dot(p) / determinant;
  const double v = direction.dot(q) / determinant;
  const double t = (c - a).dot(q) / determinant;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < 1.0 - 1e-9;
}

std::vector<char> BruteForce(const PointCloud& mesh, const Eigen::Vector3d& eye) {
  std::vector<char> visible(mesh.size(), 0);
  for (int k = 0; k < static_cast<int>(mesh.size()); ++k) {
    bool faces = false;
    bool hidden = false;
    for (const auto& t : mesh.triangles) {
      const Eigen::Vector3d& a = mesh.points[t[0]];
      const Eigen::Vector3d& b = mesh.points[t[1]];
      const Eigen::Vector3d& c = mesh.points[t[2]];
      if (t[0] == k || t[1] == k || t[2] == k) {
        faces = faces || (b - a).cross(c - a).dot(eye - a) > 0.0;
      } else {
        hidden = hidden || Crosses(eye, mesh.points[k], a, b, c);
      }
    }
    visible[k] = faces && !hidden;
  }
  return visible;
}

PointCloud Ball(int vertices) {
  SyntheticSolid solid(0.01);
  solid.Add({{{0.0, 0.0, 0.0, 1.0}}, Eigen::Vector3d::UnitZ(), 1.0});
  return RemeshUniformly(MarchTetrahedra(solid, 0.08), solid, vertices);
}

TEST(VisibleVertices, OfABallAreTheCapThatTheCameraSees) {
  const PointCloud ball = Ball(1500);
  SyntheticView view;
  view.eye = Eigen::Vector3d(0.0, -4.0, 0.0);
  // The rim of the cap is at n . eye = 1; a vertex within one edge length (0.1) of it may count
  // either way.
  const auto visible = VisibleVertices(ball, view);
  for (std::size_t k = 0; k < ball.size(); ++k) {
    const double beyond = ball.points[k].dot(view.eye) / 4.0 - 0.25;
    if (std::abs(beyond) <= 0.1) continue;
    EXPECT_EQ(visible[k] != 0, beyond > 0.0) << k;
  }
  view.parallel = true;
  const auto half = VisibleVertices(ball, view);
  int count = 0;
  for (std::size_t k = 0; k < ball.size(); ++k) {
    count += half[k];
    if (std::abs(ball.points[k].y()) <= 0.1) continue;
    EXPECT_EQ(half[k] != 0, ball.points[k].y() < 0.0) << k;
  }
  EXPECT_NEAR(count / static_cast<double>(ball.size()), 0.5, 0.03);
}

TEST(VisibleVertices, AgreeWithATestOfEveryRayAgainstEveryTriangle) {
  const PointCloud heart = MakeSyntheticShape(SyntheticShape::kHeart, 900, 1.0);
  for (const Eigen::Vector3d& eye :
       {Eigen::Vector3d(-0.3, -1.6, 0.2), Eigen::Vector3d(0.4, 0.9, 1.5)}) {
    SyntheticView view;
    view.eye = eye;
    EXPECT_EQ(VisibleVertices(heart, view), BruteForce(heart, eye));
  }
}

TEST(VisibleVertices, EndAtTheRimOfThePicture) {
  const PointCloud plane = MakeSyntheticShape(SyntheticShape::kPlane, 900, 2.0);
  SyntheticView view;
  view.half_angle_deg = 30.0;
  const auto visible = VisibleVertices(plane, view);
  for (std::size_t k = 0; k < plane.size(); ++k) {
    EXPECT_EQ(visible[k] != 0, plane.points[k].norm() <= std::tan(30.0 * M_PI / 180.0)) << k;
  }
  view.eye = Eigen::Vector3d(0.0, 0.0, -1.0);
  const auto behind = VisibleVertices(plane, view);
  EXPECT_EQ(std::count(behind.begin(), behind.end(), 1), 0) << "the sheet has one side";
}

TEST(VisiblePart, HoldsTheFacingTrianglesOfVisibleVertices) {
  const PointCloud ball = Ball(600);
  SyntheticView view;
  view.eye = Eigen::Vector3d(0.0, -3.0, 1.0);
  std::vector<int> kept;
  const PointCloud part = VisiblePart(ball, view, &kept);
  const auto visible = VisibleVertices(ball, view);
  ASSERT_EQ(kept.size(), part.size());
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  for (std::size_t k = 0; k < part.size(); ++k) {
    EXPECT_EQ(part.points[k], ball.points[kept[k]]);
    EXPECT_TRUE(visible[kept[k]]);
  }
  std::size_t expected = 0;
  for (const auto& t : ball.triangles) {
    const Eigen::Vector3d& a = ball.points[t[0]];
    const bool faces = (ball.points[t[1]] - a).cross(ball.points[t[2]] - a).dot(view.eye - a) > 0.0;
    expected += faces && visible[t[0]] && visible[t[1]] && visible[t[2]];
  }
  EXPECT_EQ(part.triangles.size(), expected);
  EXPECT_GT(expected, ball.triangles.size() / 4);
}

TEST(Random, GaussianHasTheMomentsOfTheNormalDistribution) {
  Random random(7);
  constexpr int kCount = 200000;
  double sum = 0.0;
  double squares = 0.0;
  double fourths = 0.0;
  for (int k = 0; k < kCount; ++k) {
    const double x = random.Gaussian();
    sum += x;
    squares += x * x;
    fourths += x * x * x * x;
  }
  // Four standard errors: of the mean 1, of the square sqrt(2), of the fourth power sqrt(96).
  const double error = 4.0 / std::sqrt(static_cast<double>(kCount));
  EXPECT_NEAR(sum / kCount, 0.0, error);
  EXPECT_NEAR(squares / kCount, 1.0, error * std::sqrt(2.0));
  EXPECT_NEAR(fourths / kCount, 3.0, error * std::sqrt(96.0));
}

TEST(SyntheticNoise, HasItsDeviationAndDependsOnItsSeedAlone) {
  PointCloud first = MakeSyntheticShape(SyntheticShape::kPlane, 10000, 1.0);
  const PointCloud clean = first;
  PointCloud second = first;
  PointCloud other = first;
  AddSyntheticNoise(0.01, 3, &first);
  AddSyntheticNoise(0.01, 3, &second);
  AddSyntheticNoise(0.01, 4, &other);
  EXPECT_EQ(first.points, second.points);
  EXPECT_NE(first.points, other.points);
  double squares = 0.0;
  for (std::size_t k = 0; k < clean.size(); ++k) {
    squares += (first.points[k] - clean.points[k]).squaredNorm();
  }
  // Four standard errors of a standard deviation from n values: 4 / sqrt(2 n).
  const double count = 3.0 * static_cast<double>(clean.size());
  EXPECT_NEAR(std::sqrt(squares / count), 0.01, 0.01 * 4.0 / std::sqrt(2.0 * count));
}

}  // namespace
}  // namespace ceres_ed
