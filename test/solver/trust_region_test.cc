#include "ceres_ed/solver/trust_region.h"

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

TEST(TrustRegion, GrowsThreefoldAfterAStepAsGoodAsPromised) {
  TrustRegion region(2.0);
  region.Grow(1.0);
  EXPECT_DOUBLE_EQ(region.radius(), 6.0);
}

TEST(TrustRegion, StaysAfterAStepHalfAsGood) {
  TrustRegion region(2.0);
  region.Grow(0.5);
  EXPECT_DOUBLE_EQ(region.radius(), 2.0);
}

TEST(TrustRegion, ShrinksFasterWithEveryStepInARowThatWasNotTaken) {
  TrustRegion region(64.0);
  region.Shrink();
  EXPECT_EQ(region.radius(), 32.0);
  region.Shrink();
  EXPECT_EQ(region.radius(), 8.0);
  region.Grow(0.5);
  region.Shrink();
  EXPECT_EQ(region.radius(), 4.0);
}

TEST(TrustRegion, EndsBetweenItsLimits) {
  TrustRegion region(1e16);
  region.Grow(1.0);
  EXPECT_EQ(region.radius(), 1e16);
  EXPECT_FALSE(region.IsTooSmall());
  EXPECT_TRUE(TrustRegion(1e-33).IsTooSmall());
}

TEST(TrustRegion, AcceptsAThousandthOfWhatWasPromised) {
  EXPECT_TRUE(TrustRegion::Accepts(2e-3));
  EXPECT_FALSE(TrustRegion::Accepts(0.5e-3));
  EXPECT_FALSE(TrustRegion::Accepts(-1.0));
}

}  // namespace
}  // namespace ceres_ed
