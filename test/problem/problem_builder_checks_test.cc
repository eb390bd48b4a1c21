// How a builder handles residuals that are not valid.
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/testing/residual_collection.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/problem/strip_builder.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

// A cost function that can't be evaluated at any state.
class FailingCost final : public ceres::CostFunction {
 public:
  FailingCost() {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->push_back(kNodeSize);
  }
  bool Evaluate(double const* const*, double*, double**) const override { return false; }
};

class BlocksEnergy final : public EnergyTerm {
 public:
  BlocksEnergy(std::vector<BlockRef> blocks, double weight)
      : blocks_(std::move(blocks)), weight_(weight) {}
  EnergyKind kind() const override { return EnergyKind::kPrior; }
  void AddResiduals(const EnergyContext&, ResidualSink* sink) const override {
    sink->Add(
        std::make_unique<FailingCost>(), blocks_.data(), static_cast<int>(blocks_.size()), weight_);
  }

 private:
  std::vector<BlockRef> blocks_;
  double weight_;
};

TEST(ProblemBuilder, AResidualThatCannotBeEvaluatedMakesItsTermNotANumber) {
  StripBuilder strip(HalfSeen());
  const int term = strip.builder.AddTerm("failing", EnergyKind::kPrior);
  strip.builder.CollectResiduals(
      term, BlocksEnergy({BlockRef::Node(0)}, 1.0), strip.problem.Context());
  const EnergySummary summary = strip.builder.Evaluate(DeformationState(18));
  EXPECT_TRUE(std::isnan(summary.terms[term].raw));
  EXPECT_TRUE(std::isnan(summary.Total()));
  EXPECT_FALSE(std::isnan(summary.terms[0].raw));
}

TEST(ProblemBuilder, SaysWhichResidualDoesNotFit) {
  StripBuilder strip(HalfSeen());
  const int term = strip.builder.AddTerm("odd", EnergyKind::kPrior);
  strip.builder.SetOrigin(term, "plugin './odd.so'");
  const auto collect = [&](const std::vector<BlockRef>& blocks, double weight) {
    strip.builder.CollectResiduals(term, BlocksEnergy(blocks, weight), strip.problem.Context());
    EXPECT_EQ(strip.builder.NumResidualBlocks(term), 0);
    return strip.builder.status().message();
  };
  const std::string odd = "energy 'odd' of plugin './odd.so': residual 0 ";
  EXPECT_EQ(collect({BlockRef::Node(18)}, 1.0),
            odd + "is on node 18, which isn't there (18 nodes, no camera)");
  EXPECT_EQ(collect({BlockRef::Node(0), BlockRef::Node(1)}, 1.0),
            odd + "has 2 blocks, its cost function takes 1");
  EXPECT_EQ(collect({BlockRef::CameraRotation()}, 1.0),
            odd + "has the camera's rotation as block 0 where its cost function takes 12 numbers");
  EXPECT_EQ(collect({BlockRef::Node(0)}, -1.0),
            odd + "has weight -1.000000, expected finite and >= 0");
  EXPECT_THAT(collect({BlockRef::Node(0)}, std::nan("")), HasSubstr("has weight nan"));
}

TEST(ProblemBuilder, SaysWhichNodeAResidualTouchesTwice) {
  StripBuilder strip(HalfSeen());
  const int nodes[] = {4, 4};
  const double weights[] = {0.5, 0.5};
  strip.problem.skinning = Skinning(2);
  strip.problem.skinning.Add(nodes, weights, 2);
  strip.problem.correspondences.resize(1);
  const auto energy = strip.registry.Create("point_to_point", {});
  strip.builder.CollectResiduals(strip.data, **energy, strip.problem.Context());
  EXPECT_THAT(strip.builder.status().message(), HasSubstr("residual 0 has node 4 twice"));
}

TEST(ProblemBuilder, ATermThatCouldNotBeCollectedIsForgottenWithItsNextResiduals) {
  StripBuilder strip(HalfSeen());
  const int term = strip.builder.AddTerm("odd", EnergyKind::kPrior);
  strip.builder.CollectResiduals(
      term, BlocksEnergy({BlockRef::Node(18)}, 1.0), strip.problem.Context());
  EXPECT_FALSE(strip.builder.status().ok());
  EXPECT_TRUE(std::isnan(strip.builder.Evaluate(DeformationState(18)).Total()));
  strip.builder.CollectResiduals(
      term, BlocksEnergy({BlockRef::Node(17)}, 1.0), strip.problem.Context());
  EXPECT_TRUE(strip.builder.status().ok());
}

TEST(ProblemBuilder, NamesTheResidualThatCannotBeEvaluated) {
  StripBuilder strip(HalfSeen());
  const int term = strip.builder.AddTerm("failing", EnergyKind::kPrior);
  strip.builder.CollectResiduals(
      term, BlocksEnergy({BlockRef::Node(7)}, 1.0), strip.problem.Context());
  EXPECT_EQ(strip.builder.CheckResiduals(DeformationState(18)).message(),
            "energy 'failing': residual 0 (node 7) says that it can't be evaluated");
  strip.builder.SetWeight(term, 0.0);
  EXPECT_TRUE(strip.builder.CheckResiduals(DeformationState(18)).ok());
}

TEST(ProblemBuilderDeathTest, DiesOnAWeightThatIsNegative) {
  StripBuilder strip(HalfSeen());
  const int term = strip.builder.AddTerm("odd", EnergyKind::kPrior);
  EXPECT_DEATH(strip.builder.SetWeight(term, -2.0), "energy 'odd': weight -2");
}

TEST(ProblemBuilderDeathTest, DiesOnACameraThatIsNotThere) {
  const StripBuilder strip(HalfSeen());
  DeformationState state(18);
  EXPECT_DEATH(strip.builder.Build(FullConfig(18, true), &state), "no camera to vary");
}

}  // namespace
}  // namespace ceres_ed
