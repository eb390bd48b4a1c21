// A fit finds the orientation of its surfaces.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/geometry/normals.h>
#include <ceres_ed/geometry/orientation.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/simulation/deformations.h>
#include <ceres_ed/simulation/shapes.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

struct Pair {
  PointCloud source;
  PointCloud target;
  // The positions of the source's points after the deformation.
  PointCloud truth;
};

Pair MakePair(SyntheticShape shape) {
  Pair pair;
  pair.source = MakeSyntheticShape(shape, 600, 1.0);
  pair.target = DeformSyntheticShape(shape, 1.0, 0.3, MakeSyntheticShape(shape, 800, 1.0));
  pair.truth = DeformSyntheticShape(shape, 1.0, 0.3, pair.source);
  return pair;
}

double MeanError(const Pair& pair, const FitResult& result) {
  double sum = 0.0;
  for (std::size_t p = 0; p < pair.truth.size(); ++p) {
    sum += (result.points[p] - pair.truth.points[p]).norm();
  }
  return sum / static_cast<double>(pair.truth.size());
}

// Returns the mean error of a fit, and the result in `result` unless it is null.
double FitError(const Pair& pair, FitResult* result = nullptr) {
  StatusOr<FitResult> fit = Fit(pair.source, pair.target);
  EXPECT_TRUE(fit.ok()) << fit.status().message();
  if (!fit.ok()) return 1.0;
  const double error = MeanError(pair, *fit);
  if (result != nullptr) *result = *std::move(fit);
  return error;
}

class OrientationOfEachShape : public ::testing::TestWithParam<SyntheticShape> {};

TEST_P(OrientationOfEachShape, MayBeInsideOut) {
  Pair pair = MakePair(GetParam());
  const double expected = FitError(pair);
  FitResult result;
  ReverseOrientation(&pair.target);
  EXPECT_NEAR(FitError(pair, &result), expected, 1e-3 * expected);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("taken inside out")));
  // Now both are inside out, which is one orientation.
  ReverseOrientation(&pair.source);
  EXPECT_NEAR(FitError(pair), expected, 1e-3 * expected);
}

TEST_P(OrientationOfEachShape, MayChangeFromTriangleToTriangle) {
  Pair pair = MakePair(GetParam());
  const double expected = FitError(pair);
  for (std::size_t t = 0; t < pair.target.triangles.size(); t += 3) {
    std::swap(pair.target.triangles[t][0], pair.target.triangles[t][1]);
  }
  for (std::size_t t = 0; t < pair.source.triangles.size() / 4; ++t) {
    std::swap(pair.source.triangles[t][0], pair.source.triangles[t][1]);
  }
  FitResult result;
  EXPECT_NEAR(FitError(pair, &result), expected, 1e-3 * expected);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("triangles of the target are wound against")));
  EXPECT_THAT(result.warnings, Contains(HasSubstr("triangles of the source are wound against")));
}

INSTANTIATE_TEST_SUITE_P(Fit,
                         OrientationOfEachShape,
                         ::testing::Values(SyntheticShape::kPlane, SyntheticShape::kDolphin),
                         [](const auto& info) { return SyntheticShapeName(info.param); });

TEST(Orientation, OfNormalsThatContradictTheTrianglesIsThatOfTheTriangles) {
  Pair pair = MakePair(SyntheticShape::kDolphin);
  const double expected = FitError(pair);
  pair.target.normals = ComputeVertexNormals(pair.target);
  for (std::size_t p = 0; p < pair.target.size(); p += 3) {
    pair.target.normals[p] = -pair.target.normals[p];
  }
  FitResult result;
  EXPECT_NEAR(FitError(pair, &result), expected, 1e-3 * expected);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("of the target contradict its triangles")));
}

TEST(Orientation, OfMissingNormalsIsThatOfTheTriangles) {
  Pair pair = MakePair(SyntheticShape::kDolphin);
  const double expected = FitError(pair);
  pair.target.normals = ComputeVertexNormals(pair.target);
  for (std::size_t p = 0; p < pair.target.size(); p += 2) pair.target.normals[p].setZero();
  EXPECT_NEAR(FitError(pair), expected, 1e-3 * expected);
}

TEST(Orientation, OfBarePointsMayBeReversedOrRandom) {
  Pair pair = MakePair(SyntheticShape::kPlane);
  pair.target.normals = ComputeVertexNormals(pair.target);
  pair.target.triangles.clear();
  const double expected = FitError(pair);
  FitResult result;
  ReverseOrientation(&pair.target);
  EXPECT_NEAR(FitError(pair, &result), expected, 1e-3 * expected);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("taken inside out")));
  for (std::size_t p = 0; p < pair.target.size(); ++p) {
    if (p * p % 7 < 3) pair.target.normals[p] = -pair.target.normals[p];
  }
  EXPECT_NEAR(FitError(pair, &result), expected, 1e-3 * expected);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("their signs are chosen anew")));
}

TEST(Orientation, IsFoundWithoutARigidStage) {
  Pair pair = MakePair(SyntheticShape::kPlane);
  ReverseOrientation(&pair.target);
  FitInput input;
  input.source = pair.source;
  input.target = pair.target;
  FitOptions options;
  options.rigid_first = false;
  const StatusOr<FitResult> result = Fit(input, options, BuiltinEnergies());
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_THAT(result->warnings, Contains(HasSubstr("taken inside out")));
  EXPECT_LT(MeanError(pair, *result), 0.02);
}

}  // namespace
}  // namespace ceres_ed
