// Fits of closed bodies: what lies inside and behind goes along.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/registration/fit.h>

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

// A body with three unequal axes, and a smooth bend of space.
PointCloud Body() {
  PointCloud body = MakeSphereMesh(4);
  for (Eigen::Vector3d& point : body.points) {
    point = {1.5 * point.x() + 0.1 * point.y() * point.y(), 0.9 * point.y(), 0.5 * point.z()};
  }
  return body;
}

Eigen::Vector3d Bent(const Eigen::Vector3d& p) {
  const double angle = 0.35 * p.x();
  const double radius = 1.0 / 0.35 - p.z();
  return {radius * std::sin(angle), p.y(), 1.0 / 0.35 - radius * std::cos(angle)};
}

PointCloud Line() {
  PointCloud line;
  for (int i = 0; i <= 200; ++i) {
    const double x = -1.1 + 0.011 * i;
    line.points.emplace_back(x, 0.2 * std::sin(3.0 * x), 0.1 * std::cos(2.0 * x));
  }
  return line;
}

StatusOr<FitResult> FitBody(VolumeRule volume) {
  FitInput input;
  input.source = Body();
  input.target = input.source;
  for (Eigen::Vector3d& point : input.target.points) point = Bent(point);
  FitOptions options;
  options.volume = volume;
  return Fit(input, options, BuiltinEnergies());
}

// Returns the largest change of a distance between neighbours on the line, as a factor.
double LargestStretch(const FitResult& fit) {
  const PointCloud line = Line();
  PointCloud moved = line;
  CHECK(ApplyWarp(fit.warp, &moved).ok());
  double largest = 1.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double ratio = (moved.points[i] - moved.points[i - 1]).norm() /
                         (line.points[i] - line.points[i - 1]).norm();
    largest = std::max({largest, ratio, 1.0 / ratio});
  }
  return largest;
}

TEST(VolumeFit, WhatLiesInsideGoesAlongSmoothly) {
  const StatusOr<FitResult> with = FitBody(VolumeRule::kAuto);
  const StatusOr<FitResult> without = FitBody(VolumeRule::kOff);
  ASSERT_TRUE(with.ok() && without.ok());
  EXPECT_GT(with->warp.graph.num_inner_nodes(), 0);
  EXPECT_EQ(without->warp.graph.num_inner_nodes(), 0);
  // The truth changes distances by up to 1.1 times.
  EXPECT_LT(LargestStretch(*with), 1.25);
  EXPECT_LT(LargestStretch(*with), LargestStretch(*without));
}

TEST(VolumeFit, AnOpenSourceHasNoInnerNodesByItself) {
  FitInput input;
  input.source = Body();
  // A tenth of the triangles is missing.
  input.source.triangles.resize(input.source.triangles.size() * 9 / 10);
  input.target = input.source;
  const StatusOr<FitResult> result = Fit(input, FitOptions(), BuiltinEnergies());
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->warp.graph.num_inner_nodes(), 0);
}

TEST(VolumeFit, HasTheSameBitsAtAnyThreadCount) {
  FitInput input;
  input.source = Body();
  input.target = input.source;
  for (Eigen::Vector3d& point : input.target.points) point = Bent(point);
  FitOptions options;
  const StatusOr<FitResult> one = Fit(input, options, BuiltinEnergies());
  options.num_threads = 3;
  const StatusOr<FitResult> three = Fit(input, options, BuiltinEnergies());
  ASSERT_TRUE(one.ok() && three.ok());
  EXPECT_EQ(one->points, three->points);
}

}  // namespace
}  // namespace ceres_ed
