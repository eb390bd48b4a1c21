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

TEST(ImageView, LooksAtAnImage) {
  Image<int> image(3, 2);
  const ImageView<int> view = image;
  image(2, 1) = 5;
  EXPECT_EQ(view.width(), 3);
  EXPECT_EQ(view.height(), 2);
  EXPECT_EQ(view.pixels(), image.pixels().data());
  EXPECT_EQ(&view(2, 1), &image(2, 1));
  EXPECT_EQ(ImageView<int>(&image).pixels(), view.pixels());
}

TEST(ImageView, LooksAtPixelsOfOthers) {
  const float pixels[] = {0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F};
  const DepthView view(pixels, 2, 3);
  EXPECT_FALSE(view.empty());
  EXPECT_EQ(view(1, 0), 1.0F);
  EXPECT_EQ(view(0, 2), 4.0F);
}

TEST(ImageView, MayHaveNoPixels) {
  EXPECT_TRUE(DepthView().empty());
  EXPECT_TRUE(DepthView(nullptr).empty());
  EXPECT_TRUE(DepthView(DepthImage(0, 5)).empty());
}

}  // namespace
}  // namespace ceres_ed
