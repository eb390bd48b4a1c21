#include <ceres_ed/pipeline/apply/field_run.h>
#include <ceres_ed/pipeline/apply/warp_field.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/geometry/meshes.h>
#include <test/graph/warp_examples.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

std::unique_ptr<const SpaceWarp> Create(const Warp& warp) { return *SpaceWarp::Create(warp); }

FieldGrid MakeGrid(int size, double spacing) {
  FieldGrid grid;
  grid.size = {size, size + 1, size - 1};
  grid.spacing.setConstant(spacing);
  grid.origin.setConstant(-0.5);
  return grid;
}

TEST(ForwardField, HasTheDisplacementOfEachPoint) {
  const auto warp = Create(MakeLatticeWarp(4, 0.3, 0.2));
  RunObserver silent;
  const FieldGrid grid = MakeGrid(8, 0.5);
  const auto field = FillForwardField(*warp, grid, {}, 1, &silent);
  ASSERT_TRUE(field.has_value());
  ASSERT_EQ(field->vectors.size(), 3 * grid.num_points());
  const Eigen::Vector3d x = grid.Position(3, 7, 2);
  const Eigen::Vector3d expected = (*warp)(x)-x;
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(field->vectors[3 * grid.Index(3, 7, 2) + c], static_cast<float>(expected[c]));
  }
}

TEST(Field, IsTheSameOnAnyNumberOfThreads) {
  const auto warp = Create(MakeLatticeWarp(4, 0.3, 0.2));
  RunObserver silent;
  const FieldGrid grid = MakeGrid(9, 0.5);
  InverseQuality one;
  InverseQuality three;
  EXPECT_EQ(FillForwardField(*warp, grid, {}, 1, &silent)->vectors,
            FillForwardField(*warp, grid, {}, 3, &silent)->vectors);
  const auto a = FillInverseField(*warp, grid, {}, NoInverse::kNearest, 1, &silent, &one);
  const auto b = FillInverseField(*warp, grid, {}, NoInverse::kNearest, 3, &silent, &three);
  EXPECT_EQ(a->vectors, b->vectors);
  EXPECT_EQ(one.mean_residual, three.mean_residual);
  EXPECT_EQ(one.num_folded, three.num_folded);
}

TEST(InverseField, LeadsBackToWhereTheForwardFieldCameFrom) {
  const Warp warp = MakeBendingWarp(4, 0.3);
  const auto space = Create(warp);
  RunObserver silent;
  InverseQuality quality;
  const auto field =
      FillInverseField(*space, MakeGrid(20, 0.2), {}, NoInverse::kNan, 1, &silent, &quality);
  EXPECT_LE(quality.mean_residual, 1e-6);
  EXPECT_EQ(quality.num_without, 0u);
  EXPECT_EQ(quality.num_folded, 0u);
  std::vector<Eigen::Vector3d> source = RandomPoints(200, 8);
  std::vector<Eigen::Vector3d> target;
  for (Eigen::Vector3d& x : source) {
    x += Eigen::Vector3d::Constant(1.5);
    target.push_back((*space)(x));
  }
  const FieldError error = MeasureField(*field, {}, target, source);
  EXPECT_EQ(error.num_points, 200u);
  EXPECT_LT(error.max, 0.05);
  EXPECT_GT(error.mean, 0.0);
}

// All nodes are moved to the plane z = 0: nothing else is reached.
Warp MakeFlatWarp() {
  Warp warp = MakeLatticeWarp(3, 0.0, 0.0);
  for (int j = 0; j < warp.graph.num_nodes(); ++j) {
    MutableNodeAffine(warp.state.node(j)) = Eigen::Vector3d(1, 1, 0).asDiagonal();
    MutableNodeTranslation(warp.state.node(j)) = Eigen::Vector3d(0, 0, -warp.graph.position(j).z());
  }
  return warp;
}

TEST(InverseField, HasWhatIsWishedWhereTheWarpHasNoInverse) {
  const auto warp = Create(MakeFlatWarp());
  RunObserver silent;
  FieldGrid grid = MakeGrid(4, 0.5);
  grid.origin = {0.0, 0.0, 1.0};
  const std::size_t last = 3 * grid.num_points() - 1;
  InverseQuality quality;
  const auto fill = [&](NoInverse rule) {
    return FillInverseField(*warp, grid, {}, rule, 1, &silent, &quality)->vectors[last];
  };
  EXPECT_TRUE(std::isnan(fill(NoInverse::kNan)));
  EXPECT_EQ(quality.num_without, grid.num_points());
  EXPECT_EQ(fill(NoInverse::kZero), 0.0f);
  EXPECT_TRUE(std::isfinite(fill(NoInverse::kNearest)));
}

TEST(InterpolateField, IsLinearBetweenPointsAndEndsAtTheGrid) {
  DisplacementField field;
  field.grid.size = {2, 2, 1};
  field.grid.spacing = {2.0, 1.0, 1.0};
  field.vectors = {0, 0, 0, 4, 0, 0, 0, 8, 0, 4, 8, 0};
  EXPECT_EQ(*InterpolateField(field, {0.5, 0.5, 0.0}), Eigen::Vector3d(1, 4, 0));
  EXPECT_EQ(*InterpolateField(field, {2.0, 1.0, 0.0}), Eigen::Vector3d(4, 8, 0));
  EXPECT_FALSE(InterpolateField(field, {2.1, 0.5, 0.0}).has_value());
  EXPECT_FALSE(InterpolateField(field, {0.5, 0.5, 0.1}).has_value());
  field.vectors[3] = std::nanf("");
  EXPECT_FALSE(InterpolateField(field, {0.5, 0.5, 0.0}).has_value());
  EXPECT_TRUE(InterpolateField(field, {0.0, 0.5, 0.0}).has_value());
}

// Stops a run after a few slices.
class Stopper : public RunObserver {
 public:
  bool ShouldStop() override { return ++asked_ > 3; }

 private:
  int asked_ = 0;
};

class FieldStopper : public FieldObserver {
 public:
  bool ShouldStop() override { return true; }
};

TEST(Field, IsNotWrittenIfTheRunIsStopped) {
  const auto warp = Create(MakeLatticeWarp(3, 0.1, 0.1));
  Stopper stopper;
  EXPECT_FALSE(FillForwardField(*warp, MakeGrid(9, 0.5), {}, 1, &stopper).has_value());
  const TemporaryDirectory directory;
  FieldSettings settings;
  settings.field = directory / "f.nrrd";
  FieldStopper at_once;
  const Outcome outcome = RunField(settings, "w.json", warp->warp(), nullptr, &at_once);
  EXPECT_EQ(outcome.code, ExitCode::kStoppedEarly);
  EXPECT_FALSE(std::filesystem::exists(settings.field));
}

}  // namespace
}  // namespace ceres_ed
