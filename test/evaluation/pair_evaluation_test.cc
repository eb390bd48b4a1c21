#include "ceres_ed/evaluation/pair_evaluation.h"

#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// Returns a grid of `side` x `side` vertices with unit spacing in z = `height`.
PointCloud Grid(int side, double height) {
  PointCloud mesh;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) mesh.points.emplace_back(x, y, height);
  }
  for (int y = 0; y + 1 < side; ++y) {
    for (int x = 0; x + 1 < side; ++x) {
      const int a = y * side + x;
      mesh.triangles.push_back({a, a + 1, a + side + 1});
      mesh.triangles.push_back({a, a + side + 1, a + side});
    }
  }
  return mesh;
}

// Returns a ball made of parallels and meridians.
PointCloud Ball(int rings, double radius) {
  const int columns = 2 * rings;
  PointCloud mesh;
  mesh.points.emplace_back(0, 0, radius);
  for (int r = 1; r < rings; ++r) {
    for (int c = 0; c < columns; ++c) {
      const double theta = M_PI * r / rings;
      const double phi = 2.0 * M_PI * c / columns;
      mesh.points.emplace_back(radius * Eigen::Vector3d(std::sin(theta) * std::cos(phi),
                                                        std::sin(theta) * std::sin(phi),
                                                        std::cos(theta)));
    }
  }
  mesh.points.emplace_back(0, 0, -radius);
  const int last = static_cast<int>(mesh.size()) - 1;
  for (int c = 0; c < columns; ++c) {
    const int d = (c + 1) % columns;
    mesh.triangles.push_back({0, 1 + c, 1 + d});
    for (int r = 0; r + 2 < rings; ++r) {
      const int a = 1 + r * columns;
      mesh.triangles.push_back({a + c, a + columns + c, a + columns + d});
      mesh.triangles.push_back({a + c, a + columns + d, a + d});
    }
    const int a = 1 + (rings - 2) * columns;
    mesh.triangles.push_back({a + c, last, a + d});
  }
  return mesh;
}

TEST(Summarize, AgreesWithPaperAndPencil) {
  const DistanceStatistics s = Summarize({5.0, 1.0, 2.0, 4.0, 3.0});
  EXPECT_DOUBLE_EQ(s.mean, 3.0);
  EXPECT_DOUBLE_EQ(s.rms, std::sqrt(11.0));
  EXPECT_DOUBLE_EQ(s.p50, 3.0);
  EXPECT_DOUBLE_EQ(s.p95, 4.8);
  EXPECT_DOUBLE_EQ(s.p99, 4.96);
  EXPECT_DOUBLE_EQ(s.max, 5.0);
  EXPECT_DOUBLE_EQ(s.trimmed, 2.5);
  EXPECT_DOUBLE_EQ(s.InPercentOf(50.0).mean, 6.0);
  EXPECT_EQ(Summarize({}).max, 0.0);
}

TEST(Evaluate, FindsNothingWrongWithTheTargetItself) {
  const PointCloud mesh = Ball(12, 2.0);
  const auto e = Evaluate(mesh, mesh, &mesh, &mesh);
  ASSERT_TRUE(e.ok()) << e.status().message();
  EXPECT_LT(e->symmetric.max, 1e-12);
  EXPECT_EQ(e->nearest_forward.max, 0.0);
  EXPECT_EQ(e->nearest_backward.max, 0.0);
  EXPECT_EQ(e->point_to_plane, 0.0);
  // acos is flat at 1, so that rounding of 1e-16 becomes an angle of 1e-8.
  EXPECT_LT(e->normal_error_deg.value(), 1e-5);
  EXPECT_EQ(e->truth->max, 0.0);
  EXPECT_EQ(e->shape->edge_p99, 0.0);
  EXPECT_EQ(e->shape->flipped, 0);
  EXPECT_EQ(e->shape->degenerate, 0);
}

TEST(Evaluate, GivesTheShiftOfAPlane) {
  const PointCloud target = Grid(11, 0.0);
  const PointCloud result = Grid(11, 0.3);
  const auto e = Evaluate(result, target, &target, &target);
  ASSERT_TRUE(e.ok()) << e.status().message();
  EXPECT_DOUBLE_EQ(e->diagonal, std::sqrt(200.0));
  for (const double value : {e->forward.mean,
                             e->backward.max,
                             e->symmetric.rms,
                             e->symmetric.p50,
                             e->symmetric.trimmed,
                             e->nearest_forward.p95,
                             e->truth->mean,
                             e->point_to_plane.value()}) {
    EXPECT_NEAR(value, 0.3, 1e-12);
  }
  EXPECT_EQ(e->shape->edge_p99, 0.0);
  EXPECT_EQ(e->shape->edges, 2 * 11 * 10 + 100);
  EXPECT_EQ(e->shape->flipped, 0);
}

TEST(Evaluate, MeasuresToTheSurfaceNotToVertices) {
  // The result is shifted within its plane by half a cell. It lies on the surface, except for the
  // column beyond the border.
  const PointCloud target = Grid(11, 0.0);
  PointCloud result = target;
  for (auto& point : result.points) point.x() += 0.5;
  const auto e = Evaluate(result, target, nullptr, nullptr);
  ASSERT_TRUE(e.ok()) << e.status().message();
  EXPECT_NEAR(e->forward.mean, 0.5 / 11.0, 1e-12);
  EXPECT_NEAR(e->nearest_forward.mean, 0.5, 1e-12);
  EXPECT_FALSE(e->truth.has_value());
  EXPECT_FALSE(e->shape.has_value());
}

TEST(Evaluate, GivesTheGapOfConcentricBalls) {
  const PointCloud target = Ball(60, 2.0);
  const PointCloud result = Ball(60, 1.5);
  const auto e = Evaluate(result, target, &target, nullptr);
  ASSERT_TRUE(e.ok()) << e.status().message();
  // The faces lie inside their ball by at most the sagitta r (pi / 60)^2 / 4 (both diagonals).
  const double sagitta = 2.0 * std::pow(M_PI / 60.0, 2) / 4.0;
  EXPECT_NEAR(e->forward.mean, 0.5, sagitta);
  EXPECT_NEAR(e->backward.mean, 0.5, sagitta);
  EXPECT_NEAR(e->nearest_forward.max, 0.5, 1e-9);
  EXPECT_NEAR(e->shape->edge_mean, 0.25, 1e-9);
  EXPECT_NEAR(e->shape->edge_p99, 0.25, 1e-9);
  EXPECT_LT(e->normal_error_deg.value(), 1e-4);
  // The mesh is turned inside out, so that every normal is reversed.
  PointCloud inverted = result;
  for (auto& t : inverted.triangles) std::swap(t[1], t[2]);
  EXPECT_NEAR(Evaluate(inverted, target)->normal_error_deg.value(), 180.0, 1e-4);
}

TEST(Evaluate, CountsAVertexOutsideEveryTriangleAsPartOfTheTarget) {
  PointCloud target = Grid(3, 0.0);
  target.points.emplace_back(1.0, 1.0, 5.0);
  PointCloud result;
  result.points = {{1.0, 1.0, 5.0}};
  EXPECT_EQ(Evaluate(result, target)->forward.max, 0.0);
}

TEST(Evaluate, FitsBarePoints) {
  PointCloud target;
  target.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  PointCloud result = target;
  for (auto& point : result.points) point.z() += 0.25;
  const auto e = Evaluate(result, target, &target, nullptr);
  ASSERT_TRUE(e.ok()) << e.status().message();
  EXPECT_DOUBLE_EQ(e->symmetric.mean, 0.25);
  EXPECT_FALSE(e->point_to_plane.has_value());
  EXPECT_FALSE(e->normal_error_deg.has_value());
  EXPECT_EQ(e->shape->edges, 3);
}

TEST(MeasureShapeChange, IsBlindToRigidMotion) {
  const PointCloud source = Ball(10, 1.0);
  PointCloud result = source;
  const Eigen::AngleAxisd turn(2.5, Eigen::Vector3d(1, 2, 3).normalized());
  for (auto& point : result.points) point = turn * point + Eigen::Vector3d(4, 5, 6);
  const ShapeChange change = MeasureShapeChange(source, result);
  EXPECT_LT(change.edge_p99, 1e-12);
  EXPECT_EQ(change.flipped, 0);
  EXPECT_EQ(change.degenerate, 0);
}

TEST(MeasureShapeChange, FindsAFlipAndACollapse) {
  const PointCloud source = Grid(12, 0.0);
  PointCloud pushed = source;
  // Vertex 65 at (5, 5) moves beyond its right neighbours, so that the triangles on that side turn
  // over.
  pushed.points[65].x() += 1.6;
  EXPECT_GT(MeasureShapeChange(source, pushed).flipped, 0);
  PointCloud collapsed = source;
  collapsed.points[65] = collapsed.points[66];
  const ShapeChange change = MeasureShapeChange(source, collapsed);
  EXPECT_EQ(change.degenerate, 2) << "an inner edge has two triangles";
  EXPECT_EQ(change.flipped, 0);
}

TEST(Evaluate, RefusesWhatItCannotCompare) {
  const PointCloud mesh = Grid(3, 0.0);
  const PointCloud other = Grid(4, 0.0);
  EXPECT_NE(Evaluate(mesh, other, &other).status().message().find("source has 16 points"),
            std::string::npos);
  EXPECT_NE(Evaluate(mesh, other, nullptr, &other).status().message().find("truth has 16 points"),
            std::string::npos);
  EXPECT_FALSE(Evaluate(PointCloud(), mesh).ok());
  EXPECT_FALSE(Evaluate(mesh, PointCloud()).ok());
  PointCloud broken = mesh;
  broken.points[4].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(Evaluate(broken, mesh).status().message().find("point 4 of the result"),
            std::string::npos);
}

}  // namespace
}  // namespace ceres_ed
