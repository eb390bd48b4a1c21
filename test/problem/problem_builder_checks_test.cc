// What a builder does with residuals that are no good.
#include <ceres_ed/problem/problem_builder.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <test/problem/strip_builder.h>

namespace ceres_ed {
namespace {

TestProblemOptions HalfSeen() {
  TestProblemOptions options;
  options.observed_columns = 2;
  return options;
}

// Cannot be evaluated anywhere.
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

TEST(ProblemBuilderDeathTest, DiesOnResidualsThatDoNotFit) {
  StripBuilder strip(HalfSeen());
  const int term = strip.builder.AddTerm("odd", EnergyKind::kPrior);
  const auto collect = [&](const std::vector<BlockRef>& blocks, double weight) {
    strip.builder.CollectResiduals(term, BlocksEnergy(blocks, weight), strip.problem.Context());
  };
  EXPECT_DEATH(collect({BlockRef::Node(18)}, 1.0), "energy 'odd': node 18 of 18");
  EXPECT_DEATH(collect({BlockRef::Node(0), BlockRef::Node(1)}, 1.0), "energy 'odd'");
  EXPECT_DEATH(collect({BlockRef::CameraRotation()}, 1.0), "block size");
  EXPECT_DEATH(collect({BlockRef::Node(0)}, -1.0), "energy 'odd': residual weight -1");
  EXPECT_DEATH(collect({BlockRef::Node(0)}, std::nan("")), "residual weight");
  EXPECT_DEATH(strip.builder.SetWeight(term, -2.0), "energy 'odd': weight -2");
}

TEST(ProblemBuilderDeathTest, DiesOnANodeThatAResidualTouchesTwice) {
  StripBuilder strip(HalfSeen());
  const int nodes[] = {4, 4};
  const double weights[] = {0.5, 0.5};
  strip.problem.skinning = Skinning(2);
  strip.problem.skinning.Add(nodes, weights, 2);
  strip.problem.correspondences.resize(1);
  const auto energy = strip.registry.Create("point_to_point", {});
  EXPECT_DEATH(strip.builder.CollectResiduals(strip.data, **energy, strip.problem.Context()),
               "blocks 0 and 1 are the same");
}

TEST(ProblemBuilderDeathTest, DiesOnACameraThatIsNotThere) {
  const StripBuilder strip(HalfSeen());
  DeformationState state(18);
  EXPECT_DEATH(strip.builder.Build(FullConfig(18, true), &state), "no camera to vary");
}

}  // namespace
}  // namespace ceres_ed
