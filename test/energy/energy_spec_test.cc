#include "ceres_ed/energy/energy_spec.h"

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <ceres/loss_function.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

std::string ParseError(const std::string& text) {
  return ParseEnergySpecs(text).status().message();
}

TEST(ParseEnergySpecs, ReadsEnergiesWithTheirParameters) {
  const auto specs = ParseEnergySpecs(
      "point_to_plane:weight=2.5,loss=huber,loss_width=1e-2;rotation;pose_prior:rotation_sigma=3");
  ASSERT_TRUE(specs.ok()) << specs.status().message();
  ASSERT_EQ(specs->size(), 3u);
  const EnergySpec& first = (*specs)[0];
  EXPECT_EQ(first.name, "point_to_plane");
  EXPECT_EQ(first.weight, 2.5);
  EXPECT_EQ(first.loss.type, LossType::kHuber);
  EXPECT_EQ(first.loss.width, 0.01);
  EXPECT_THAT(first.parameters, IsEmpty());
  EXPECT_EQ((*specs)[1].name, "rotation");
  EXPECT_EQ((*specs)[2].name, "pose_prior");
  EXPECT_THAT((*specs)[2].parameters, ElementsAre(Pair("rotation_sigma", 3.0)));
}

TEST(ParseEnergySpecs, LeavesDefaultsWhereNothingIsGiven) {
  const auto specs = ParseEnergySpecs("rotation:");
  ASSERT_TRUE(specs.ok());
  ASSERT_EQ(specs->size(), 1u);
  EXPECT_EQ((*specs)[0].weight, EnergySpec().weight);
  EXPECT_EQ((*specs)[0].loss.type, LossType::kSquared);
  EXPECT_EQ((*specs)[0].loss.width, LossSpec().width);
}

TEST(ParseEnergySpecs, SkipsEmptyPieces) {
  EXPECT_EQ(ParseEnergySpecs(";rotation;;regularization;")->size(), 2u);
  EXPECT_THAT(*ParseEnergySpecs(""), IsEmpty());
}

TEST(ParseEnergySpecs, NamesThePieceThatCannotBeRead) {
  EXPECT_EQ(ParseError(":weight=1"), "energy ':weight=1': expected NAME[:param=value,...]");
  EXPECT_EQ(ParseError("rotation:weight"), "energy 'rotation': 'weight', expected param=value");
  EXPECT_EQ(ParseError("rotation:=3"), "energy 'rotation': '=3', expected param=value");
  EXPECT_EQ(ParseError("rotation:weight=1,,loss=huber"),
            "energy 'rotation': '', expected param=value");
  EXPECT_EQ(ParseError("rotation:weight=1;x:y=z"), "energy 'x': y='z', expected a finite number");
}

TEST(ParseEnergySpecs, RefusesValuesThatAreNoNumbers) {
  for (const std::string value : {"", "abc", "1.0x", "1 2", "inf", "nan", "1e999"}) {
    EXPECT_EQ(ParseError("rotation:gain=" + value),
              "energy 'rotation': gain='" + value + "', expected a finite number");
  }
}

TEST(ParseEnergySpecs, RefusesWeightsAndWidthsOutOfRange) {
  EXPECT_EQ(ParseError("rotation:weight=-0.5"), "energy 'rotation': weight=-0.5, expected >= 0");
  EXPECT_TRUE(ParseEnergySpecs("rotation:weight=0").ok());
  EXPECT_EQ(ParseError("rotation:loss_width=0"), "energy 'rotation': loss_width=0, expected > 0");
  EXPECT_EQ(ParseError("rotation:loss_width=-1"), "energy 'rotation': loss_width=-1, expected > 0");
}

TEST(ParseEnergySpecs, RefusesAnUnknownLoss) {
  EXPECT_EQ(ParseError("rotation:loss=hubert"),
            "loss 'hubert', expected one of: squared, huber, cauchy, tukey, welsch, geman_mcclure");
}

TEST(LossType, HasANameThatIsReadBack) {
  for (const LossType type : {LossType::kSquared,
                              LossType::kHuber,
                              LossType::kCauchy,
                              LossType::kTukey,
                              LossType::kWelsch,
                              LossType::kGemanMcClure}) {
    const StatusOr<LossType> read = ParseLossType(NameOf(type));
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(*read, type);
  }
}

TEST(MakeLoss, IsNullForTheSquaredLoss) { EXPECT_EQ(MakeLoss(LossSpec()), nullptr); }

// rho(s) at s = 4 a^2, which is large enough for all six to differ.
TEST(MakeLoss, HasTheFormOfItsName) {
  constexpr double kWidth = 0.3;
  constexpr double kS = 4.0 * kWidth * kWidth;
  const std::vector<std::pair<LossType, double>> expected{{LossType::kHuber, 3.0},
                                                          {LossType::kCauchy, std::log(5.0)},
                                                          {LossType::kTukey, 1.0 / 3.0},
                                                          {LossType::kWelsch, 1.0 - std::exp(-4.0)},
                                                          {LossType::kGemanMcClure, 0.8}};
  for (const auto& [type, in_squared_widths] : expected) {
    double rho[3];
    MakeLoss({type, kWidth})->Evaluate(kS, rho);
    EXPECT_NEAR(rho[0], in_squared_widths * kWidth * kWidth, 1e-15) << NameOf(type);
  }
}

TEST(MakeLossDeathTest, DiesOnAWidthThatIsNotPositive) {
  EXPECT_DEATH(MakeLoss({LossType::kHuber, 0.0}), "loss width 0");
}

TEST(EnergySpec, RefusesAWidthWithoutALoss) {
  EXPECT_EQ(ParseEnergySpecs("rotation:loss_width=0.5").status().message(),
            "energy 'rotation': loss_width has no use without a loss, expected loss=huber or "
            "another");
  EXPECT_TRUE(ParseEnergySpecs("rotation:loss_width=0.5,loss=huber").ok());
}

}  // namespace
}  // namespace ceres_ed
