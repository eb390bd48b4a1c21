// What a fit reports while it runs.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/simulation/deformations.h>
#include <ceres_ed/simulation/shapes.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// Returns a target that is not a rigid copy of the source, so that there is a finish.
PointCloud BentKidney() {
  constexpr SyntheticShape kShape = SyntheticShape::kKidney;
  return DeformSyntheticShape(kShape, 1.0, 0.3, MakeSyntheticShape(kShape, 600, 1.0));
}

std::vector<std::string> StagesOf(FitOptions options) {
  FitInput input;
  input.source = MakeSyntheticShape(SyntheticShape::kKidney, 500, 1.0);
  input.target = BentKidney();
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
  input.target = BentKidney();
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
  input.target = BentKidney();
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

// A fit of a target of which some triangles are wound against the others, which its preparation
// finds. should_stop returns true when it is called for the `first`th time, and then for ever if
// `stays`. `polls` is the number of calls before a graph was built.
FitResult StoppedAt(int first, bool stays, int* polls) {
  FitInput input;
  input.source = MakeSyntheticShape(SyntheticShape::kKidney, 500, 1.0);
  input.target = BentKidney();
  for (std::size_t t = 0; t < input.target.triangles.size(); t += 5) {
    std::swap(input.target.triangles[t][0], input.target.triangles[t][1]);
  }
  FitOptions options;
  bool is_prepared = false;
  int calls = 0;
  *polls = 0;
  options.on_progress = [&](const FitProgress& progress) {
    is_prepared = is_prepared || progress.stage == "graph";
  };
  options.should_stop = [&] {
    ++calls;
    if (!is_prepared) *polls = calls;
    return calls == first || (stays && calls > first);
  };
  StatusOr<FitResult> fit = Fit(input, options, BuiltinEnergies());
  EXPECT_TRUE(fit.ok()) << fit.status().message();
  return fit.ok() ? *std::move(fit) : FitResult();
}

bool SpeaksOfWinding(const FitResult& result) {
  return std::any_of(
      result.warnings.begin(), result.warnings.end(), [](const std::string& warning) {
        return warning.find("wound against") != std::string::npos;
      });
}

TEST(FitProgress, PreparesNothingAfterAStop) {
  int polls = 0;
  EXPECT_TRUE(SpeaksOfWinding(StoppedAt(/*first=*/0, /*stays=*/false, &polls)));
  const FitResult result = StoppedAt(/*first=*/1, /*stays=*/true, &polls);
  EXPECT_EQ(result.status, SolveStatus::kInterrupted);
  EXPECT_FALSE(SpeaksOfWinding(result));
  EXPECT_FALSE(result.evidence.measured);
}

// The preparation looks whether it must stop between its long steps. A stop that is seen there
// counts, even if nobody asks for it any more, and leaves the source at its placement.
TEST(FitProgress, MayBeStoppedBetweenTheStepsOfThePreparation) {
  const PointCloud source = MakeSyntheticShape(SyntheticShape::kKidney, 500, 1.0);
  int polls = 0;
  StoppedAt(/*first=*/0, /*stays=*/false, &polls);
  // Source: before and amid. Target: before, at the start, amid and behind. Rigid: at the start,
  // after the given pose, before the last refinement. Unit frame: before each part of the target.
  EXPECT_GE(polls, 11);
  for (const bool stays : {false, true}) {
    for (int first = 1; first <= polls; ++first) {
      int seen = 0;
      const FitResult result = StoppedAt(first, stays, &seen);
      EXPECT_TRUE(result.IsUsable());
      EXPECT_EQ(result.status, SolveStatus::kInterrupted) << "poll " << first;
      EXPECT_EQ(result.outer_iterations, 0);
      EXPECT_FALSE(result.evidence.measured);
      ASSERT_EQ(result.points.size(), source.size());
      for (std::size_t p = 0; p < source.size(); ++p) {
        EXPECT_LT((result.points[p] - result.rigid * source.points[p]).norm(), 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace ceres_ed
