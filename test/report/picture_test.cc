#include "small_fit.h"

#include <ceres_ed/report/picture/panel.h>
#include <ceres_ed/report/picture/png.h>
#include <ceres_ed/report/picture/scene_picture.h>
#include <ceres_ed/report/picture/text_drawing.h>

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace ceres_ed {
namespace {

const ThemeColors kLight = ColorsOf(Theme::kLight);

// The square [-1, 1]^2 in the plane z = 0, with a field from 0 at the left to 1 at the right.
ViewSurface Square() {
  ViewSurface surface;
  surface.points = {{-1.0, -1.0, 0.0}, {1.0, -1.0, 0.0}, {1.0, 1.0, 0.0}, {-1.0, 1.0, 0.0}};
  surface.triangles = {{0, 1, 2}, {0, 2, 3}};
  surface.rows = {0, 1, 2, 3};
  ScalarField field;
  field.key = "x";
  field.values = {0.0, 1.0, 1.0, 0.0};
  field.range = {0.0, 1.0, 0.0, 1.0};
  surface.fields.push_back(field);
  return surface;
}

// Looks at it straight on, from 1 / sin 15 deg away; its corners are at +-sin 15 deg of the frame.
ColorImage DrawSquare(const ViewSurface& surface, const std::string& field, int size) {
  PanelContents contents;
  contents.surface = &surface;
  contents.field = field;
  ViewFrame frame;
  frame.low = Eigen::Vector2d::Constant(-2.0 * std::sin(M_PI / 12.0));
  frame.high = -frame.low;
  return DrawPanel(contents, {}, {}, frame, size, size, Theme::kLight);
}

TEST(Panel, ASquareHasItsPixelsAndNoOthers) {
  const ViewSurface surface = Square();
  const ColorImage picture = DrawSquare(surface, "", 200);
  int drawn = 0;
  for (int v = 0; v < 200; ++v) {
    for (int u = 0; u < 200; ++u) {
      const bool is_inside = u >= 51 && u < 149 && v >= 51 && v < 149;
      const bool is_outside = u < 49 || u > 150 || v < 49 || v > 150;
      const bool is_drawn = picture(u, v) != kLight.ground;
      if (is_inside) EXPECT_TRUE(is_drawn) << u << " " << v;
      if (is_outside) EXPECT_FALSE(is_drawn) << u << " " << v;
      drawn += is_drawn ? 1 : 0;
    }
  }
  EXPECT_NEAR(drawn, 100 * 100, 500);
}

TEST(Panel, TheEndsOfTheRangeHaveTheirColours) {
  const ViewSurface surface = Square();
  const ColorImage picture = DrawSquare(surface, "x", 200);
  // The light of a surface that is seen straight on is 1.1; the ray to the edge is a little aside.
  const auto expect_near = [&](int u, const Rgb& color) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double lit = std::min(255.0, 1.1 * color[c]);
      EXPECT_NEAR(picture(u, 100)[c], lit, 10.0) << u << " " << c;
    }
  };
  expect_near(52, ColorAt(ColorScale::kMagnitude, 0.0));
  expect_near(148, ColorAt(ColorScale::kMagnitude, 1.0));
}

TEST(Panel, TheUpperCornerIsUpAndTheNearerSurfaceIsInFront) {
  ViewSurface surface = Square();
  // A small red-end square in front of the upper right corner.
  for (const Eigen::Vector3d& at : {Eigen::Vector3d(0.4, 0.4, 0.2),
                                    Eigen::Vector3d(0.8, 0.4, 0.2),
                                    Eigen::Vector3d(0.8, 0.8, 0.2),
                                    Eigen::Vector3d(0.4, 0.8, 0.2)}) {
    surface.points.push_back(at);
  }
  surface.triangles.push_back({4, 5, 6});
  surface.triangles.push_back({4, 6, 7});
  surface.fields[0].values = {0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0};
  const ColorImage picture = DrawSquare(surface, "x", 200);
  EXPECT_GT(picture(131, 69)[0], 200) << "yellow";
  EXPECT_LT(picture(131, 131)[0], 100) << "violet";
}

TEST(Panel, PointsWithoutTrianglesAreDiscs) {
  ViewSurface surface = Square();
  surface.triangles.clear();
  const ColorImage picture = DrawSquare(surface, "", 200);
  EXPECT_NE(picture(50, 50), kLight.ground);
  EXPECT_EQ(picture(100, 100), kLight.ground);
}

TEST(ScenePicture, HasPanelsBesideEachOther) {
  const SmallFit fit = MakeSmallFit();
  const FitView view = MakeFitView(fit.Parts());
  PictureOptions options;
  options.width = 800;
  options.title = "title";
  const ColorImage picture = DrawScene(view.scene, options);
  EXPECT_EQ(picture.width(), 800);
  // Source, target, result and graph.
  for (int panel = 0; panel < 4; ++panel) {
    int drawn = 0;
    for (int v = 0; v < picture.height(); ++v) {
      for (int u = 200 * panel; u < 200 * (panel + 1); ++u) {
        drawn += picture(u, v) != kLight.ground ? 1 : 0;
      }
    }
    EXPECT_GT(drawn, 2000) << panel;
  }
}

TEST(ScenePicture, IsDarkIfThatIsAskedFor) {
  const FitView view = MakeFitView(MakeSmallFit().Parts());
  PictureOptions options;
  options.width = 400;
  options.theme = Theme::kDark;
  EXPECT_EQ(DrawScene(view.scene, options)(0, 0), ColorsOf(Theme::kDark).ground);
}

TEST(ScenePicture, NothingToSeeIsEmpty) { EXPECT_TRUE(DrawScene(Scene(), {}).empty()); }

TEST(Text, IsAsWideAsItIsDrawn) {
  if (!HasPictures()) GTEST_SKIP() << kNoPictures;
  ColorImage picture(400, 60, Rgb{255, 255, 255});
  DrawText("Hello", 20.0, 40.0, 32.0, Rgb{0, 0, 0}, &picture);
  int first = 400;
  int last = 0;
  for (int v = 0; v < 60; ++v) {
    for (int u = 0; u < 400; ++u) {
      if (picture(u, v)[0] > 128) continue;
      first = std::min(first, u);
      last = std::max(last, u);
    }
  }
  EXPECT_NEAR(first, 22, 3);
  EXPECT_NEAR(last - first, TextWidth("Hello", 32.0), 6.0);
}

TEST(Text, StaysWithinItsRoomAndThePicture) {
  if (!HasPictures()) GTEST_SKIP() << kNoPictures;
  const std::string text(300, 'm');
  EXPECT_LE(TextWidth(FitText(text, 20.0, 150.0), 20.0), 150.0);
  EXPECT_EQ(FitText("short", 20.0, 150.0), "short");
  ColorImage picture(30, 10, Rgb{255, 255, 255});
  DrawText(text + "\xff\x01\xE2\x80\xAE", -10.0, 8.0, 20.0, Rgb{0, 0, 0}, &picture);
}

TEST(Png, IsReadBackWithTheSamePixels) {
  if (!HasPictures()) GTEST_SKIP() << kNoPictures;
  ColorImage picture(37, 11);
  for (int v = 0; v < 11; ++v) {
    for (int u = 0; u < 37; ++u) {
      picture(u, v) = {static_cast<std::uint8_t>(7 * u), static_cast<std::uint8_t>(20 * v), 99};
    }
  }
  const std::string bytes = EncodePng(picture);
  const cv::Mat read =
      cv::imdecode(std::vector<unsigned char>(bytes.begin(), bytes.end()), cv::IMREAD_COLOR);
  ASSERT_EQ(read.cols, 37);
  ASSERT_EQ(read.rows, 11);
  for (int v = 0; v < 11; ++v) {
    for (int u = 0; u < 37; ++u) {
      const cv::Vec3b pixel = read.at<cv::Vec3b>(v, u);
      EXPECT_EQ((Rgb{pixel[2], pixel[1], pixel[0]}), picture(u, v));
    }
  }
  EXPECT_EQ(EncodePng(ColorImage()), "");
}

}  // namespace
}  // namespace ceres_ed
