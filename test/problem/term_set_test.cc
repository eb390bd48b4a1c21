#include "ceres_ed/problem/term_set.h"

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/testing/test_problem.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const EnergyRegistry& Builtin() {
  static const EnergyRegistry* registry = [] {
    auto* made = new EnergyRegistry;
    RegisterBuiltinEnergies(made);
    return made;
  }();
  return *registry;
}

// The strip of MakeTestProblem with a set of terms.
struct StripTerms {
  explicit StripTerms(bool has_camera = false)
      : problem(MakeTestProblem(Options(has_camera))), builder(problem.graph, has_camera) {
    inputs.context = problem.Context();
  }

  static TestProblemOptions Options(bool has_camera) {
    TestProblemOptions options;
    options.has_camera = has_camera;
    return options;
  }

  void Add(const std::string& energy, const TermRule& rule, double weight = 3.0) {
    const LossSpec loss = {LossType::kHuber, 0.5};
    const Status status = terms.Add(Builtin(), {energy, {energy, weight, loss, {}}, rule});
    ASSERT_TRUE(status.ok()) << status.message();
  }

  TestProblem problem;
  TermInputs inputs;
  TermSet terms;
  ProblemBuilder builder;
};

TEST(TermSet, WeighsByUnitStiffnessAndScale) {
  StripTerms strip;
  TermRule plain;
  plain.unit = 2.0;
  TermRule stiff = plain;
  stiff.stiff = true;
  TermRule mean = stiff;
  mean.scale = WeightScale::kPerResidual;
  TermRule observed = plain;
  observed.scale = WeightScale::kPerObservedNode;
  for (const TermRule& rule : {plain, stiff, mean}) strip.Add("rotation", rule);
  strip.Add("point_to_point", observed);
  strip.inputs.stiffness = 5.0;
  strip.inputs.nodes_per_observation = 0.25;
  strip.terms.AddTo(strip.inputs, TermLevels::kLevelOne, &strip.builder);
  EXPECT_EQ(strip.builder.weight(0), 3.0 * 2.0);
  EXPECT_EQ(strip.builder.weight(1), 3.0 * 2.0 * 5.0);
  // One residual a node.
  EXPECT_DOUBLE_EQ(strip.builder.weight(2), 3.0 * 2.0 * 5.0 / 18);
  EXPECT_EQ(strip.builder.weight(3), 3.0 * 2.0 * 0.25);
  strip.inputs.stiffness = 1.0;
  strip.terms.Weigh(strip.inputs, &strip.builder);
  EXPECT_EQ(strip.builder.weight(1), 3.0 * 2.0);
}

TEST(TermSet, TakesTheWidthOfALossFromWhereItsRuleSays) {
  StripTerms strip;
  TermRule planes;
  planes.loss_width = LossWidth::kCorrespondences;
  TermRule features;
  features.loss_width = LossWidth::kFeatures;
  strip.Add("point_to_plane", planes);
  strip.Add("landmark", features);
  // The same energies of a user's have the width that the user gave them.
  strip.Add("point_to_plane", {});
  strip.Add("landmark", {});
  strip.inputs.correspondence_width = 0.125;
  strip.inputs.feature_width = 0.25;
  strip.terms.AddTo(strip.inputs, TermLevels::kLevelOne, &strip.builder);
  const double expected[] = {0.125, 0.25, 0.5, 0.5};
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(strip.builder.loss(i).width, expected[i]) << i;
    EXPECT_EQ(strip.builder.loss(i).type, LossType::kHuber) << i;
  }
}

TEST(TermSet, LeavesTermsOfLevelOneEmptyInHiddenLevels) {
  StripTerms strip(/*has_camera=*/true);
  TermRule level_one;
  level_one.levels = TermLevels::kLevelOne;
  strip.Add("rotation", {});
  strip.Add("pose_prior", level_one);
  strip.Add("point_to_point", level_one);
  strip.terms.AddTo(strip.inputs, TermLevels::kAll, &strip.builder);
  EXPECT_EQ(strip.builder.NumResidualBlocks(0), 18);
  EXPECT_EQ(strip.builder.NumResidualBlocks(1), 0);
  EXPECT_EQ(strip.builder.NumResidualBlocks(2), 0);
  ProblemBuilder level_one_builder(strip.problem.graph, /*has_camera=*/true);
  strip.terms.AddTo(strip.inputs, TermLevels::kLevelOne, &level_one_builder);
  EXPECT_EQ(level_one_builder.NumResidualBlocks(1), 1);
  EXPECT_EQ(level_one_builder.NumResidualBlocks(2), 10);
}

TEST(TermSet, ShowsEachTermThePairsOfItsRule) {
  StripTerms strip;
  const std::vector<Correspondence> few(strip.problem.correspondences.begin(),
                                        strip.problem.correspondences.begin() + 3);
  TermRule thinned;
  thinned.matched = true;
  thinned.thinned = true;
  TermRule pinned;
  pinned.pairs = PairSource::kPinned;
  strip.Add("point_to_point", thinned);
  strip.Add("landmark", pinned);
  strip.Add("landmark", {});
  strip.terms.AddTo(strip.inputs, TermLevels::kLevelOne, &strip.builder);
  // Where there are none of them, a term sees none.
  EXPECT_EQ(strip.builder.NumResidualBlocks(0), 0);
  EXPECT_EQ(strip.builder.NumResidualBlocks(1), 0);
  EXPECT_EQ(strip.builder.NumResidualBlocks(2), 2);
  strip.inputs.thinned = &few;
  strip.inputs.pinned = &few;
  strip.terms.CollectMatched(strip.inputs, &strip.builder);
  EXPECT_EQ(strip.builder.NumResidualBlocks(0), 3);
  // Pinned points stay what they were: they aren't matched.
  EXPECT_EQ(strip.builder.NumResidualBlocks(1), 0);
  ProblemBuilder other(strip.problem.graph, /*has_camera=*/false);
  strip.terms.AddTo(strip.inputs, TermLevels::kLevelOne, &other);
  EXPECT_EQ(other.NumResidualBlocks(1), 3);
}

TEST(TermSet, CollectsAnewWhatIsMatched) {
  StripTerms strip;
  TermRule matched;
  matched.matched = true;
  matched.loss_width = LossWidth::kCorrespondences;
  strip.Add("point_to_point", matched);
  strip.Add("point_to_plane", {});
  strip.terms.AddTo(strip.inputs, TermLevels::kLevelOne, &strip.builder);
  const std::vector<Correspondence> none;
  strip.inputs.context.correspondences = &none;
  strip.inputs.correspondence_width = 0.75;
  strip.terms.CollectMatched(strip.inputs, &strip.builder);
  EXPECT_EQ(strip.builder.NumResidualBlocks(0), 0);
  EXPECT_EQ(strip.builder.loss(0).width, 0.75);
  EXPECT_EQ(strip.builder.NumResidualBlocks(1), 10);
}

TEST(TermSet, NamesTermsOfTheUserThatHaveAddedNothing) {
  StripTerms strip;
  TermRule users;
  users.is_users = true;
  strip.Add("landmark", {});
  strip.Add("landmark", users);
  strip.Add("rotation", users);
  strip.inputs.context.landmarks = nullptr;
  const std::vector<Correspondence> none;
  strip.inputs.context.landmarks = &none;
  EXPECT_THAT(strip.terms.IdleEnergies(), ElementsAre("landmark", "rotation"));
  strip.terms.AddTo(strip.inputs, TermLevels::kLevelOne, &strip.builder);
  EXPECT_THAT(strip.terms.IdleEnergies(), ElementsAre("landmark"));
  // Once is enough.
  strip.inputs.context.landmarks = &strip.problem.landmarks;
  ProblemBuilder later(strip.problem.graph, /*has_camera=*/false);
  strip.terms.AddTo(strip.inputs, TermLevels::kLevelOne, &later);
  EXPECT_TRUE(strip.terms.IdleEnergies().empty());
}

TEST(TermSet, RefusesWhatNoProblemCanWeigh) {
  TermSet terms;
  const auto message = [&terms](const EnergySpec& energy) {
    return terms.Add(Builtin(), {energy.name, energy, {}}).message();
  };
  EXPECT_EQ(message({"rotation", -1.0, {}, {}}),
            "energy 'rotation': weight is -1, expected in [0, 1e100]");
  EXPECT_THAT(message({"rotation", std::nan(""), {}, {}}), HasSubstr("weight is nan"));
  EXPECT_THAT(message({"rotation", std::numeric_limits<double>::infinity(), {}, {}}),
              HasSubstr("weight is inf"));
  EXPECT_EQ(message({"landmark", 1.0, {LossType::kHuber, 0.0}, {}}),
            "energy 'landmark': loss_width is 0, expected finite and > 0");
  EXPECT_THAT(message({"elastic", 1.0, {}, {}}), HasSubstr("elastic"));
  EXPECT_EQ(terms.size(), 0);
}

}  // namespace
}  // namespace ceres_ed
