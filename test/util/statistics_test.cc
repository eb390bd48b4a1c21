#include "ceres_ed/util/statistics.h"

#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

TEST(Median, IsTheOneInTheMiddle) {
  EXPECT_EQ(Median(std::vector<double>{5.0, -1.0, 0.5}), 0.5);
  EXPECT_EQ(Median(std::vector<float>{2.0F}), 2.0F);
}

TEST(Median, IsTheUpperOneOfTwoInTheMiddle) {
  EXPECT_EQ(Median(std::vector<double>{3.0, 1.0, 4.0, 2.0}), 3.0);
}

TEST(Median, IsZeroWithoutValues) { EXPECT_EQ(Median(std::vector<double>()), 0.0); }

TEST(InterpolatedMedian, IsTheMeanOfTheTwoInTheMiddle) {
  EXPECT_EQ(InterpolatedMedian({3.0, 1.0, 4.0, 2.0}), 2.5);
  EXPECT_EQ(InterpolatedMedian({5.0, -1.0, 0.5}), 0.5);
  EXPECT_EQ(InterpolatedMedian({}), 0.0);
}

TEST(RobustDeviation, IsThatOfAGaussianForItsMedian) {
  EXPECT_EQ(RobustDeviation({}), 0.0);
  EXPECT_DOUBLE_EQ(RobustDeviation({-2.0}), 2.9652);
  EXPECT_DOUBLE_EQ(RobustDeviation({5.0, -1.0, 0.5}), 1.4826);
}

TEST(RobustDeviation, IsNotMovedByOutliers) {
  EXPECT_EQ(RobustDeviation({1.0, 1.0, 1.0, 1e9}), RobustDeviation({1.0, 1.0, 1.0, 1.0}));
}

}  // namespace
}  // namespace ceres_ed
