// What a fit reports while it runs.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/simulation/shapes.h>

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

std::vector<std::string> StagesOf(FitOptions options) {
  FitInput input;
  input.source = MakeSyntheticShape(SyntheticShape::kKidney, 500, 1.0);
  input.target = MakeSyntheticShape(SyntheticShape::kKidney, 600, 1.0);
  std::vector<std::string> stages;
  options.on_progress = [&stages](const FitProgress& progress) {
    stages.push_back(progress.stage);
  };
  const StatusOr<FitResult> fit = Fit(input, options, BuiltinEnergies());
  EXPECT_TRUE(fit.ok()) << fit.status().message();
  return stages;
}

TEST(FitProgress, GoesThroughTheStagesInTheirOrder) {
  std::vector<std::string> stages = StagesOf(FitOptions());
  stages.erase(std::unique(stages.begin(), stages.end()), stages.end());
  EXPECT_EQ(stages, (std::vector<std::string>{"rigid", "graph", "fit", "finish", "unfold"}));
}

TEST(FitProgress, NeverGoesBack) {
  FitInput input;
  input.source = MakeSyntheticShape(SyntheticShape::kKidney, 500, 1.0);
  input.target = MakeSyntheticShape(SyntheticShape::kKidney, 600, 1.0);
  FitOptions options;
  std::vector<double> fractions;
  options.on_progress = [&fractions](const FitProgress& progress) {
    fractions.push_back(progress.fraction);
  };
  ASSERT_TRUE(Fit(input, options, BuiltinEnergies()).ok());
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.front(), 0.0);
  EXPECT_GT(fractions.back(), 0.9);
  EXPECT_LE(fractions.back(), 1.0);
}

TEST(FitProgress, HasNoRigidStageWhereTheSourceIsNotPlaced) {
  FitOptions options;
  options.rigid_first = false;
  const std::vector<std::string> stages = StagesOf(options);
  EXPECT_FALSE(stages.empty());
  EXPECT_EQ(std::count(stages.begin(), stages.end(), "rigid"), 0);
}

// A fit that is stopped in any stage ends with a usable result.
TEST(FitProgress, MayBeStoppedInEachStage) {
  FitInput input;
  input.source = MakeSyntheticShape(SyntheticShape::kKidney, 500, 1.0);
  input.target = MakeSyntheticShape(SyntheticShape::kKidney, 600, 1.0);
  for (const std::string last : {"rigid", "graph", "fit", "finish"}) {
    FitOptions options;
    bool stop = false;
    options.on_progress = [&](const FitProgress& progress) {
      stop = stop || progress.stage == last;
    };
    options.should_stop = [&stop] { return stop; };
    const StatusOr<FitResult> fit = Fit(input, options, BuiltinEnergies());
    ASSERT_TRUE(fit.ok()) << fit.status().message();
    EXPECT_EQ(fit->points.size(), input.source.size());
    EXPECT_TRUE(fit->IsUsable());
    EXPECT_EQ(fit->status, SolveStatus::kInterrupted) << last;
    EXPECT_TRUE(fit->warp.finish.empty());
  }
}

}  // namespace
}  // namespace ceres_ed
