#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/geometry/spatial_order.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/registration/sorted_input.h>
#include <ceres_ed/simulation/shapes.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

FitOptions FewSteps() {
  FitOptions options;
  options.schedule.levels = 1;
  options.schedule.fine_steps = 2;
  options.graph.target_nodes = 60;
  options.finish = false;
  return options;
}

// A sheet of more points than a fit leaves in their order, bent upward.
FitInput LargeSheet() {
  FitInput input;
  input.source = MakeSyntheticShape(SyntheticShape::kPlane, 130000, 1.0);
  input.target = MakeSyntheticShape(SyntheticShape::kPlane, 3000, 1.0);
  for (Eigen::Vector3d& p : input.target.points) p.z() += 0.05 * std::sin(4 * p.x()) * p.y();
  input.landmarks = {{17, input.source.points[17]}};
  return input;
}

std::vector<int> Shuffle(std::size_t size) {
  std::vector<int> order(size);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  return order;
}

TEST(SortedInput, MakesTheFitOfALargeCloudTheSameInAnyOrder) {
  const FitInput given = LargeSheet();
  const std::vector<int> order = Shuffle(given.source.size());
  const std::vector<int> place = InverseOrder(order);
  FitInput shuffled = given;
  shuffled.source = Reordered(given.source, order);
  shuffled.landmarks[0].point = place[17];
  const auto one = Fit(given, FewSteps(), BuiltinEnergies());
  const auto other = Fit(shuffled, FewSteps(), BuiltinEnergies());
  ASSERT_TRUE(one.ok()) << one.status().message();
  ASSERT_TRUE(other.ok()) << other.status().message();
  ASSERT_EQ(one->points.size(), other->points.size());
  double moved = 0.0;
  for (std::size_t i = 0; i < one->points.size(); ++i) {
    const auto at = static_cast<std::size_t>(place[i]);
    EXPECT_EQ(one->points[i], other->points[at]);
    EXPECT_EQ(one->skinning[i].nodes[0], other->skinning[at].nodes[0]);
    moved = std::max(moved, (one->points[i] - given.source.points[i]).norm());
  }
  EXPECT_GT(moved, 0.01);
  // The warp says the same: it does not know of the order.
  PointCloud applied = given.source;
  ASSERT_TRUE(ApplyWarp(one->warp, &applied).ok());
  for (std::size_t i = 0; i < applied.size(); ++i) {
    EXPECT_LT((applied.points[i] - one->points[i]).norm(), 1e-12);
  }
  // Matches name points as the caller knows them.
  for (const Correspondence& match : other->matches.correspondences) {
    const Eigen::Vector3d& point = shuffled.source.points[static_cast<std::size_t>(match.point)];
    ASSERT_LT(std::abs(point.x()), 0.51);
  }
}

TEST(SortedInput, SurfaceFittersHaveTheBitsOfFit) {
  const FitInput input = LargeSheet();
  const EnergyRegistry registry = BuiltinEnergies();
  const auto fitter = SurfaceFitter::Create(input.source, FewSteps(), registry);
  ASSERT_TRUE(fitter.ok()) << fitter.status().message();
  const auto one = (*fitter)->Fit(input.target, input.landmarks, {});
  const auto other = Fit(input, FewSteps(), registry);
  ASSERT_TRUE(one.ok() && other.ok());
  EXPECT_EQ(one->points, other->points);
}

TEST(SortedInput, ErrorsNameThePointsThatTheCallerKnows) {
  FitInput input = LargeSheet();
  input.fixed_points = {99000, static_cast<int>(input.source.size())};
  const auto result = Fit(input, FewSteps(), BuiltinEnergies());
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.status().message(), HasSubstr(std::to_string(input.source.size())));
}

TEST(SortedInput, LeavesSmallCloudsAndThoseOfAddedEnergiesInTheirOrder) {
  const FitInput input = LargeSheet();
  FitOptions options = FewSteps();
  EXPECT_TRUE(IsSorted(input.source, options));
  EXPECT_FALSE(IsSorted(input.target, options));
  options.extra_energies.emplace_back();
  EXPECT_FALSE(IsSorted(input.source, options));
}

}  // namespace
}  // namespace ceres_ed
