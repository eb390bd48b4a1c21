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

TEST(FitProgress, BeginsWithTheRigidStage) {
  const std::vector<std::string> stages = StagesOf(FitOptions());
  ASSERT_GT(stages.size(), 1u);
  EXPECT_EQ(stages.front(), "rigid");
  EXPECT_EQ(std::count(stages.begin() + 1, stages.end(), "fit"),
            static_cast<long>(stages.size()) - 1);
}

TEST(FitProgress, HasNoRigidStageWhereTheSourceIsNotPlaced) {
  FitOptions options;
  options.rigid_first = false;
  const std::vector<std::string> stages = StagesOf(options);
  EXPECT_FALSE(stages.empty());
  EXPECT_EQ(std::count(stages.begin(), stages.end(), "rigid"), 0);
}

}  // namespace
}  // namespace ceres_ed
