// Fits with large articulated motion, in which closest points lead limbs to wrong ones.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/registration/fit.h>

#include <gtest/gtest.h>
#include <test/registration/walker.h>

namespace ceres_ed {
namespace {

FitResult FitWalker(const PointCloud& source, const WalkerPose& pose, const char* hypotheses) {
  FitInput input;
  input.source = source;
  input.target = MoveWalker(pose, MakeWalker(2600));
  FitOptions options;
  options.hypotheses = hypotheses;
  StatusOr<FitResult> result = Fit(input, options, BuiltinEnergies());
  CHECK(result.ok()) << result.status().message();
  return *std::move(result);
}

// A foreleg swings over to the other side, and a hind leg over to the other side.
const WalkerPose kCrossed = {{0.0, 0.6, -0.6, 0.0}, {1.0, 0.0, 0.0, -1.0}, 0.3};

TEST(IntrinsicStart, BringsCrossedLegsToTheirPlaces) {
  const PointCloud source = MakeWalker(3000);
  const PointCloud truth = MoveWalker(kCrossed, source);
  const double along_points =
      MeanErrorPercent(FitWalker(source, kCrossed, "careful,bold").points, truth);
  const FitResult fit = FitWalker(source, kCrossed, "");
  const double error = MeanErrorPercent(fit.points, truth);
  EXPECT_EQ(fit.hypothesis, "intrinsic");
  EXPECT_LT(error, 0.6);
  EXPECT_GT(along_points, 1.5 * error);
}

TEST(IntrinsicStart, IsNotTriedWhereClosestPointsExplainBothSurfaces) {
  const PointCloud source = MakeWalker(3000);
  const WalkerPose near = {{0.2, -0.2, 0.1, 0.0}, {}, 0.2};
  EXPECT_NE(FitWalker(source, near, "").hypothesis, "intrinsic");
}

TEST(IntrinsicStart, LeavesTheSourceAtRestIfThereIsNone) {
  const PointCloud source = MakeWalker(2000);
  FitInput input;
  input.source = source;
  input.target = MoveWalker({{0.2, -0.2, 0.1, 0.0}, {}, 0.2}, MakeWalker(2600));
  // A landmark says more than lengths do, so there is no intrinsic start beside it.
  input.landmarks = {{0, source.points[0]}};
  FitOptions options;
  options.hypotheses = "intrinsic";
  const StatusOr<FitResult> result = Fit(input, options, BuiltinEnergies());
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_TRUE(result->IsUsable());
}

TEST(IntrinsicStart, LeavesTheSourceAtRestIfTheTargetIsAViewOfIt) {
  FitInput input;
  input.source = MakeWalker(2000);
  input.target = MoveWalker({{0.2, -0.2, 0.1, 0.0}, {}, 0.2}, MakeWalker(2600));
  // A third of a surface has other harmonics than the whole, so there are no matches.
  input.target.triangles.resize(input.target.triangles.size() / 3);
  FitOptions options;
  options.hypotheses = "intrinsic";
  const StatusOr<FitResult> result = Fit(input, options, BuiltinEnergies());
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_TRUE(result->IsUsable()) << result->message;
}

}  // namespace
}  // namespace ceres_ed
