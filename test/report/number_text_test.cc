#include <ceres_ed/report/view/number_text.h>

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;

TEST(ShortNumber, HasTheDigitsThatAreAskedFor) {
  EXPECT_EQ(ShortNumber(0.0), "0");
  EXPECT_EQ(ShortNumber(0.012345), "0.0123");
  EXPECT_EQ(ShortNumber(1.5), "1.50");
  EXPECT_EQ(ShortNumber(-12.345, 4), "-12.35");
  EXPECT_EQ(ShortNumber(12345.0), "12345");
  EXPECT_EQ(ShortNumber(1.5e-7), "1.50e-07");
  EXPECT_EQ(ShortNumber(2.5e9, 2), "2.5e+09");
}

TEST(ShortNumber, WhatIsNotFiniteIsADash) {
  EXPECT_EQ(ShortNumber(std::nan("")), "-");
  EXPECT_EQ(ShortNumber(std::numeric_limits<double>::infinity()), "-");
}

TEST(RoundTicks, AreRoundNumbersWithinTheRange) {
  EXPECT_THAT(RoundTicks(0.0, 10.0, 5), ElementsAre(0.0, 2.0, 4.0, 6.0, 8.0, 10.0));
  EXPECT_THAT(RoundTicks(-0.13, 0.11, 5),
              ElementsAre(DoubleEq(-0.1), DoubleEq(-0.05), 0.0, DoubleEq(0.05), DoubleEq(0.1)));
}

TEST(RoundTicks, AnEmptyRangeHasOneTick) {
  EXPECT_THAT(RoundTicks(3.0, 3.0, 5), ElementsAre(3.0));
  EXPECT_THAT(RoundTicks(3.0, 2.0, 5), ElementsAre(3.0));
}

TEST(RoundTicks, EndInARangeOfRoundingErrors) {
  EXPECT_LE(RoundTicks(1e17, 1e17 + 32.0, 5).size(), 8U);
}

}  // namespace
}  // namespace ceres_ed
