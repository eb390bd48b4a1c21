#include <ceres_ed/report/view/color_map.h>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// Rec. 709 luma, in [0, 255].
double Lightness(const Rgb& color) {
  return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
}

TEST(ColorMap, TheEndsOfTheRangeHaveTheEndsOfTheTable) {
  EXPECT_EQ(ColorAt(ColorScale::kMagnitude, 0.0), (Rgb{68, 1, 84}));
  EXPECT_EQ(ColorAt(ColorScale::kMagnitude, 1.0), (Rgb{253, 231, 37}));
  EXPECT_EQ(ColorAt(ColorScale::kSigned, 0.0), (Rgb{5, 48, 97}));
  EXPECT_EQ(ColorAt(ColorScale::kSigned, 1.0), (Rgb{103, 0, 31}));
}

TEST(ColorMap, ValuesBeyondTheEndsHaveTheColoursOfTheEnds) {
  for (const ColorScale scale : {ColorScale::kMagnitude, ColorScale::kSigned}) {
    EXPECT_EQ(ColorAt(scale, -7.0), ColorAt(scale, 0.0));
    EXPECT_EQ(ColorAt(scale, std::numeric_limits<double>::infinity()), ColorAt(scale, 1.0));
  }
}

TEST(ColorMap, NanHasTheColourOfTheUnknown) {
  EXPECT_EQ(ColorAt(ColorScale::kMagnitude, std::nan("")), kUnknownColor);
}

TEST(ColorMap, MagnitudesBecomeBrighterAllTheWay) {
  const std::vector<Rgb>& table = ColorTable(ColorScale::kMagnitude);
  ASSERT_EQ(table.size(), static_cast<std::size_t>(kNumColors));
  // 8 bits make steps of up to one unit.
  for (std::size_t i = 1; i < table.size(); ++i) {
    EXPECT_GT(Lightness(table[i]), Lightness(table[i - 1]) - 1.0);
  }
}

TEST(ColorMap, SignedValuesAreBrightestAtZeroAndEquallyDarkOnBothSides) {
  const std::vector<Rgb>& table = ColorTable(ColorScale::kSigned);
  EXPECT_GT(Lightness(table[kNumColors / 2]), 235.0);
  for (int i = 0; i < kNumColors / 2; ++i) {
    EXPECT_NEAR(Lightness(table[i]), Lightness(table[kNumColors - 1 - i]), 45.0) << i;
  }
}

}  // namespace
}  // namespace ceres_ed
