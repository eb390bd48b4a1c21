#include "ceres_ed/geometry/images.h"

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

TEST(Image, StandsRowByRow) {
  Image<int> image(3, 2, 7);
  EXPECT_EQ(image.pixels(), std::vector<int>(6, 7));
  int next = 0;
  for (int v = 0; v < 2; ++v) {
    for (int u = 0; u < 3; ++u) image(u, v) = next++;
  }
  EXPECT_EQ(image.pixels(), (std::vector<int>{0, 1, 2, 3, 4, 5}));
  const Image<int>& view = image;
  EXPECT_EQ(view(2, 1), 5);
  image.pixels()[1] = 9;
  EXPECT_EQ(view(1, 0), 9);
}

TEST(Image, KnowsItsBounds) {
  const Image<char> image(3, 2);
  EXPECT_EQ(image.width(), 3);
  EXPECT_EQ(image.height(), 2);
  EXPECT_FALSE(image.empty());
  EXPECT_TRUE(image.Contains(0, 0));
  EXPECT_TRUE(image.Contains(2, 1));
  EXPECT_FALSE(image.Contains(3, 0));
  EXPECT_FALSE(image.Contains(0, 2));
  EXPECT_FALSE(image.Contains(-1, 0));
  EXPECT_FALSE(image.Contains(0, -1));
}

TEST(Image, MayHaveNoPixels) {
  EXPECT_TRUE(DepthImage().empty());
  EXPECT_TRUE(DepthImage(0, 5).empty());
  EXPECT_FALSE(DepthImage().Contains(0, 0));
}

TEST(Image, IsBlackToBeginWith) {
  EXPECT_EQ(DepthImage(2, 2)(1, 1), 0.0F);
  EXPECT_EQ(MaskImage(2, 2)(1, 1), 0);
  EXPECT_EQ(ColorImage(2, 2)(1, 1), (std::array<std::uint8_t, 3>{0, 0, 0}));
}

}  // namespace
}  // namespace ceres_ed
