// What a fit may not depend on: units, place, order, threads, luck.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/simulation/deformations.h>
#include <ceres_ed/simulation/shapes.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr SyntheticShape kShape = SyntheticShape::kDolphin;

// A dolphin of 1 m and the same one half bent, of other points.
const FitInput& DolphinInput() {
  static const FitInput input = [] {
    FitInput made;
    made.source = MakeSyntheticShape(kShape, 600, 1.0);
    made.target = DeformSyntheticShape(kShape, 1.0, 0.5, MakeSyntheticShape(kShape, 800, 1.0));
    return made;
  }();
  return input;
}

FitResult RunFit(const FitInput& input, const FitOptions& options = {}) {
  const EnergyRegistry registry = BuiltinEnergies();
  StatusOr<FitResult> result = Fit(input, options, registry);
  EXPECT_TRUE(result.ok()) << result.status().message();
  if (!result.ok()) return FitResult();
  EXPECT_TRUE(result->IsUsable()) << result->message;
  return *std::move(result);
}

void Move(const Similarity& motion, PointCloud* cloud) {
  for (Eigen::Vector3d& point : cloud->points) point = motion * point;
}

std::vector<Eigen::Vector3d> Moved(const Similarity& motion, std::vector<Eigen::Vector3d> points) {
  for (Eigen::Vector3d& point : points) point = motion * point;
  return points;
}

double LargestDistance(const std::vector<Eigen::Vector3d>& one,
                       const std::vector<Eigen::Vector3d>& other) {
  CHECK_EQ(one.size(), other.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    largest = std::max(largest, (one[i] - other[i]).norm());
  }
  return largest;
}

double MeanDistance(const std::vector<Eigen::Vector3d>& one,
                    const std::vector<Eigen::Vector3d>& other) {
  CHECK_EQ(one.size(), other.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) sum += (one[i] - other[i]).norm();
  return sum / static_cast<double>(one.size());
}

Similarity SomeMotion() {
  Similarity motion;
  motion.rotation = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, -1).normalized());
  motion.translation = {0.2, -0.3, 0.1};
  return motion;
}

class FitInvariance : public ::testing::Test {
 protected:
  const FitInput& input_ = DolphinInput();
};

TEST_F(FitInvariance, UnitsChangeNothing) {
  const FitResult metres = RunFit(input_);
  for (const double scale : {1e3, 1e-3}) {
    Similarity units;
    units.scale = scale;
    FitInput scaled = input_;
    Move(units, &scaled.source);
    Move(units, &scaled.target);
    const FitResult result = RunFit(scaled);
    EXPECT_LT(LargestDistance(result.points, Moved(units, metres.points)), 1e-6 * scale);
    EXPECT_NEAR(result.matches.rms_plane, scale * metres.matches.rms_plane, 1e-6 * scale);
  }
}

TEST_F(FitInvariance, PlaceChangesNothing) {
  const FitResult here = RunFit(input_);
  Similarity shift;
  shift.translation = {40.0, -70.0, 25.0};
  FitInput far = input_;
  Move(shift, &far.source);
  Move(shift, &far.target);
  EXPECT_LT(LargestDistance(RunFit(far).points, Moved(shift, here.points)), 1e-5);
}

TEST_F(FitInvariance, ResultFollowsTheTarget) {
  const FitResult here = RunFit(input_);
  FitInput moved = input_;
  Move(SomeMotion(), &moved.target);
  const FitResult there = RunFit(moved);
  // The rigid stage starts elsewhere, and a soft surface slides along itself a little.
  EXPECT_LT(MeanDistance(there.points, Moved(SomeMotion(), here.points)), 0.005);
  // Across itself it is where it was but for what the target's facets leave open.
  PointCloud surface = input_.source;
  surface.points = Moved(SomeMotion(), here.points);
  EXPECT_LT(Summarize(SurfaceDistances(there.points, surface)).mean, 0.001);
}

TEST_F(FitInvariance, OrderOfPointsHardlyMatters) {
  const FitResult ordered = RunFit(input_);
  std::vector<int> order(input_.source.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  FitInput shuffled = input_;
  for (std::size_t i = 0; i < order.size(); ++i) {
    shuffled.source.points[order[i]] = input_.source.points[i];
  }
  for (std::array<int, 3>& triangle : shuffled.source.triangles) {
    for (int& corner : triangle) corner = order[corner];
  }
  const FitResult result = RunFit(shuffled);
  std::vector<Eigen::Vector3d> points(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) points[i] = result.points[order[i]];
  // Nodes sit elsewhere.
  EXPECT_LT(MeanDistance(points, ordered.points), 0.005);
}

TEST_F(FitInvariance, ThreadsAndLuckChangeNoBit) {
  const FitResult first = RunFit(input_);
  for (const int threads : {1, 2, 4}) {
    FitOptions options;
    options.num_threads = threads;
    const FitResult result = RunFit(input_, options);
    EXPECT_EQ(LargestDistance(result.points, first.points), 0.0) << threads << " threads";
    EXPECT_EQ(result.final_energy.Total(), first.final_energy.Total());
  }
}

TEST_F(FitInvariance, TwoCloudsAreFittedWithDefaults) {
  const FitResult expected = RunFit(input_);
  const StatusOr<FitResult> result = Fit(input_.source, input_.target);
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_EQ(LargestDistance(result->points, expected.points), 0.0);
}

TEST_F(FitInvariance, NothingMovesWhereNothingMustMove) {
  FitInput same = input_;
  same.target = same.source;
  EXPECT_LT(LargestDistance(RunFit(same).points, same.source.points), 1e-6);
}

TEST_F(FitInvariance, NodesThatTurnInsideOutAreTold) {
  EXPECT_TRUE(RunFit(input_).warnings.empty());
  // A mirror image costs nothing where E_rot has no weight.
  FitInput mirrored;
  mirrored.source = input_.source;
  for (int i = 0; i < static_cast<int>(mirrored.source.size()); ++i) {
    const Eigen::Vector3d& point = mirrored.source.points[i];
    mirrored.landmarks.push_back({i, {point.x(), point.y(), -point.z()}});
  }
  FitOptions options;
  options.rigid_first = false;
  options.weights.rotation = 0.0;
  const FitResult result = RunFit(mirrored, options);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("inside out")));
}

}  // namespace
}  // namespace ceres_ed
