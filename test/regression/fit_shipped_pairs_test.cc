// How well default fits do, on the pairs in data/ and on real ones: no change may make them worse
// unnoticed.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/registration/fit.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

PointCloud Load(const std::string& path) {
  StatusOr<LoadedCloud> loaded = LoadCloud(path);
  EXPECT_TRUE(loaded.ok()) << loaded.status().message();
  return loaded.ok() ? std::move(loaded->cloud) : PointCloud();
}

struct Pair {
  explicit Pair(const std::string& folder)
      : source(Load(folder + "/source.ply")), target(Load(folder + "/target.ply")) {
    if (std::filesystem::exists(folder + "/gt.ply")) truth = Load(folder + "/gt.ply");
  }

  PointCloud source;
  PointCloud target;
  PointCloud truth;
};

FitResult FitPair(const Pair& pair, SolveMode mode) {
  const EnergyRegistry registry = BuiltinEnergies();
  FitInput input;
  input.source = pair.source;
  input.target = pair.target;
  FitOptions options;
  options.strategy.mode = mode;
  StatusOr<FitResult> result = Fit(input, options, registry);
  EXPECT_TRUE(result.ok()) << result.status().message();
  return result.ok() ? *std::move(result) : FitResult();
}

Evaluation Measure(const Pair& pair, const std::vector<Eigen::Vector3d>& points) {
  PointCloud result = pair.source;
  result.points = points;
  result.normals.clear();
  const PointCloud* truth = pair.truth.empty() ? nullptr : &pair.truth;
  StatusOr<Evaluation> evaluation = Evaluate(result, pair.target, &pair.source, truth);
  EXPECT_TRUE(evaluation.ok()) << evaluation.status().message();
  return evaluation.ok() ? *std::move(evaluation) : Evaluation();
}

// Mean distances in percent of the target's diagonal. Partial targets: only target to result, for
// most of the result has no counterpart.
double TruthPercent(const Evaluation& evaluation) {
  return evaluation.truth->InPercentOf(evaluation.diagonal).mean;
}
double SurfacePercent(const Evaluation& evaluation) {
  return evaluation.backward.InPercentOf(evaluation.diagonal).mean;
}

// What was measured. The test prints a row of this table for every pair: to refresh it after the
// fit has become better, copy these.
struct ShippedCase {
  const char* pair;
  SolveMode mode;
  double truth_percent;
  double surface_percent;
};
constexpr double kMargin = 1.3;
const ShippedCase kShipped[] = {
    {"plane_bumps", SolveMode::kBatch, 0.378, 0.036},
    {"plane_bumps", SolveMode::kTwoLevel, 0.378, 0.036},
    {"plane_bumps", SolveMode::kMarginal, 0.378, 0.036},
    {"dolphin_bend", SolveMode::kBatch, 0.306, 0.032},
    {"dolphin_bend", SolveMode::kTwoLevel, 0.306, 0.032},
    {"dolphin_bend", SolveMode::kMarginal, 0.306, 0.032},
    {"heart_partial", SolveMode::kBatch, 2.420, 0.046},
    {"heart_partial", SolveMode::kTwoLevel, 2.420, 0.046},
    {"heart_partial", SolveMode::kMarginal, 2.420, 0.046},
    {"kidney_partial", SolveMode::kBatch, 2.400, 0.045},
    {"kidney_partial", SolveMode::kTwoLevel, 2.400, 0.045},
    {"kidney_partial", SolveMode::kMarginal, 2.400, 0.045},
    {"stomach_partial", SolveMode::kBatch, 1.710, 0.043},
    {"stomach_partial", SolveMode::kTwoLevel, 1.710, 0.043},
    {"stomach_partial", SolveMode::kMarginal, 1.710, 0.043},
};

const char* ModeName(SolveMode mode) {
  if (mode == SolveMode::kBatch) return "Batch";
  return mode == SolveMode::kTwoLevel ? "TwoLevel" : "Marginal";
}

void PrintTo(const ShippedCase& shipped, std::ostream* stream) { *stream << shipped.pair; }

class ShippedPair : public ::testing::TestWithParam<ShippedCase> {};

TEST_P(ShippedPair, IsFittedAsWellAsEver) {
  const ShippedCase& expected = GetParam();
  const Pair pair(std::string(CERES_ED_SOURCE_DIR) + "/data/" + expected.pair);
  const FitResult result = FitPair(pair, expected.mode);
  ASSERT_TRUE(result.IsUsable()) << result.message;
  const Evaluation evaluation = Measure(pair, result.points);
  std::printf("    {\"%s\", SolveMode::k%s, %.3f, %.3f},\n",
              expected.pair,
              ModeName(expected.mode),
              TruthPercent(evaluation),
              SurfacePercent(evaluation));
  EXPECT_LT(TruthPercent(evaluation), kMargin * expected.truth_percent);
  EXPECT_LT(SurfacePercent(evaluation), kMargin * expected.surface_percent);
  EXPECT_EQ(evaluation.shape->flipped, 0);
}

INSTANTIATE_TEST_SUITE_P(Pairs, ShippedPair, ::testing::ValuesIn(kShipped), [](const auto& info) {
  return std::string(info.param.pair) + "_" + ModeName(info.param.mode);
});

// What isn't seen of the heart is marginalised: a fit with the energy, and the points, of the
// other.
TEST(ShippedPairs, MarginalFindsWhatBatchFinds) {
  const Pair pair(std::string(CERES_ED_SOURCE_DIR) + "/data/heart_partial");
  const FitResult batch = FitPair(pair, SolveMode::kBatch);
  const FitResult marginal = FitPair(pair, SolveMode::kMarginal);
  ASSERT_TRUE(marginal.IsUsable()) << marginal.message;
  EXPECT_EQ(marginal.point_relevant, batch.point_relevant);
  const double energy = batch.final_energy.Total();
  EXPECT_NEAR(marginal.final_energy.Total(), energy, 1e-6 * energy);
  double largest = 0.0;
  for (std::size_t i = 0; i < batch.points.size(); ++i) {
    largest = std::max(largest, (batch.points[i] - marginal.points[i]).norm());
  }
  EXPECT_LT(100.0 * largest / Measure(pair, batch.points).diagonal, 0.01);
}

// Real pairs, which can't be shipped: found in the folder that CERES_ED_DATA names.
class RealPair : public ::testing::Test {
 protected:
  // False, and the test is marked as skipped, where there is no such pair.
  bool Find(const std::string& name) {
    const char* data = std::getenv("CERES_ED_DATA");
    folder_ = data == nullptr ? "" : std::string(data) + "/" + name;
    return data != nullptr && std::filesystem::exists(folder_ + "/source.ply");
  }

  void ExpectTruthWithin(double percent) const {
    const Pair pair(folder_);
    const FitResult result = FitPair(pair, SolveMode::kBatch);
    ASSERT_TRUE(result.IsUsable()) << result.message;
    const double error = TruthPercent(Measure(pair, result.points));
    std::printf("%s: truth error %.3f %%\n", folder_.c_str(), error);
    EXPECT_LE(error, percent);
  }

  void ExpectCloserThanRigid() const {
    const Pair pair(folder_);
    const FitResult result = FitPair(pair, SolveMode::kBatch);
    ASSERT_TRUE(result.IsUsable()) << result.message;
    std::vector<Eigen::Vector3d> rigid = pair.source.points;
    for (Eigen::Vector3d& point : rigid) point = result.rigid * point;
    const Evaluation before = Measure(pair, rigid);
    const Evaluation after = Measure(pair, result.points);
    std::printf("%s: %.3f %% of the diagonal to the target, rigid alone %.3f %%\n",
                folder_.c_str(),
                after.symmetric.InPercentOf(after.diagonal).mean,
                before.symmetric.InPercentOf(before.diagonal).mean);
    EXPECT_LT(after.forward.mean, before.forward.mean);
    EXPECT_LT(after.backward.mean, before.backward.mean);
  }

  std::string folder_;
};

#define SKIP_WITHOUT(name) \
  if (!Find(name)) GTEST_SKIP() << "no " << (name) << " in the folder that CERES_ED_DATA names"

TEST_F(RealPair, LiverSeenFromOneSide) {
  SKIP_WITHOUT("liver_partial");
  ExpectTruthWithin(0.8);
}

TEST_F(RealPair, BearInAnotherPose) {
  SKIP_WITHOUT("bear_full");
  ExpectTruthWithin(1.5);
}

TEST_F(RealPair, HorseInAnotherPose) {
  SKIP_WITHOUT("horse_full");
  ExpectTruthWithin(3.5);
}

TEST_F(RealPair, PlushToySeenByADepthCamera) {
  SKIP_WITHOUT("snoopy_a");
  ExpectCloserThanRigid();
}

TEST_F(RealPair, ToyBearOfAnotherMesh) {
  SKIP_WITHOUT("bear_toy_debian");
  ExpectCloserThanRigid();
}

TEST_F(RealPair, PersonFromOneSide) {
  SKIP_WITHOUT("human_views");
  ExpectCloserThanRigid();
}

}  // namespace
}  // namespace ceres_ed
