#include "ceres_ed/slam/frame/pixel_tracker.h"

#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>
#include <test/slam/picture_scenes.h>

namespace ceres_ed {
namespace {

PixelTrackerOptions DenseCorners() {
  PixelTrackerOptions options;
  options.min_distance = 6.0;
  return options;
}

// Corners of the first picture, and their positions in the second.
struct Followed {
  std::vector<Eigen::Vector2d> before;
  std::vector<TrackedPixel> after;
};

Followed Follow(const ColorImage& first,
                const ColorImage& second,
                const Eigen::Vector2d& guess = Eigen::Vector2d::Zero(),
                int num_threads = 1) {
  PixelTrackerOptions options = DenseCorners();
  options.num_threads = num_threads;
  PixelTracker tracker(options);
  tracker.SetImage(first);
  // Corners keep a distance of 12 pixels from the rim, so that their windows stay inside the
  // picture.
  MaskImage inside(first.width(), first.height(), 0);
  for (int v = 12; v < first.height() - 12; ++v) {
    for (int u = 12; u < first.width() - 12; ++u) inside(u, v) = 1;
  }
  Followed followed;
  followed.before = tracker.Detect(inside, {}, 200);
  EXPECT_GT(followed.before.size(), 60u);
  std::vector<Eigen::Vector2d> predicted = followed.before;
  for (Eigen::Vector2d& p : predicted) p += guess;
  tracker.SetImage(second);
  followed.after = tracker.Track(followed.before, predicted);
  return followed;
}

std::vector<double> Errors(const Followed& followed, const Eigen::Vector2d& shift) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < followed.before.size(); ++i) {
    if (!followed.after[i].found) continue;
    errors.push_back((followed.after[i].pixel - followed.before[i] - shift).norm());
  }
  return errors;
}

// Returns the shift that one step of the plain Lucas-Kanade method computes from the true position.
Eigen::Vector2d PlainStep(const ColorImage& first,
                          const ColorImage& second_at_first,
                          const Eigen::Vector2d& pixel) {
  const auto gray = [](const ColorImage& image, int u, int v) {
    return (image(u, v)[0] + image(u, v)[1] + image(u, v)[2]) / 3.0;
  };
  Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  const int u0 = static_cast<int>(std::lround(pixel.x()));
  const int v0 = static_cast<int>(std::lround(pixel.y()));
  for (int v = v0 - 8; v <= v0 + 8; ++v) {
    for (int u = u0 - 8; u <= u0 + 8; ++u) {
      const Eigen::Vector2d gradient(0.5 * (gray(first, u + 1, v) - gray(first, u - 1, v)),
                                     0.5 * (gray(first, u, v + 1) - gray(first, u, v - 1)));
      hessian += gradient * gradient.transpose();
      right += gradient * (gray(first, u, v) - gray(second_at_first, u, v));
    }
  }
  return hessian.inverse() * right;
}

// It can go on with the next picture.
TEST(PixelTracker, TracksNothingOfAPictureThatIsForgotten) {
  PixelTracker tracker(DenseCorners());
  const ColorImage picture = TexturedPicture({0, 0}, EvenLight);
  const std::vector<Eigen::Vector2d> pixels = {{60.0, 50.0}, {80.0, 70.0}};
  tracker.SetImage(picture);
  tracker.SetImage(picture);
  tracker.ForgetPrevious();
  for (const TrackedPixel& tracked : tracker.Track(pixels, pixels)) EXPECT_FALSE(tracked.found);
  tracker.SetImage(picture);
  int found = 0;
  for (const TrackedPixel& tracked : tracker.Track(pixels, pixels)) found += tracked.found ? 1 : 0;
  EXPECT_EQ(found, 2);
}

TEST(PixelTracker, FollowsShiftsToAFractionOfAPixel) {
  for (const Eigen::Vector2d& shift :
       {Eigen::Vector2d(0.0, 0.0), {0.3, -0.4}, {2.5, 1.25}, {-5.6, 3.1}}) {
    const Followed followed =
        Follow(TexturedPicture({0, 0}, EvenLight), TexturedPicture(shift, EvenLight));
    const std::vector<double> errors = Errors(followed, shift);
    EXPECT_GT(errors.size(), 0.9 * followed.before.size()) << shift.transpose();
    EXPECT_LT(Median(errors), 0.1) << shift.transpose();
  }
}

TEST(PixelTracker, FindsFarShiftsByTheirPrediction) {
  const Eigen::Vector2d shift(31.4, -9.7);
  const ColorImage first = TexturedPicture({0, 0}, EvenLight);
  const ColorImage second = TexturedPicture(shift, EvenLight);
  const Followed followed = Follow(first, second, {30.0, -8.0});
  const std::vector<double> errors = Errors(followed, shift);
  EXPECT_GT(errors.size(), 0.6 * followed.before.size());
  EXPECT_LT(Median(errors), 0.1);
}

// The lamp moves with the camera: its light is fixed in the picture while the tissue moves.
TEST(PixelTracker, IsNotHeldBackByLightThatStandsStill) {
  const Eigen::Vector2d shift(6.0, -4.0);
  const ColorImage first = TexturedPicture({0, 0}, LampLight);
  const ColorImage second = TexturedPicture(shift, LampLight);
  const Followed followed = Follow(first, second);
  const std::vector<double> errors = Errors(followed, shift);
  EXPECT_GT(errors.size(), 0.8 * followed.before.size());
  EXPECT_LT(Median(errors), 0.1);
  // The error of the plain Lucas-Kanade method at the true position, where only the light has
  // changed.
  const ColorImage second_at_first =
      TexturedPicture({0, 0}, [&](double u, double v) { return LampLight(u + 6.0, v - 4.0); });
  std::vector<double> plain;
  for (const Eigen::Vector2d& pixel : followed.before) {
    plain.push_back(PlainStep(first, second_at_first, pixel).norm());
  }
  EXPECT_GT(Median(plain), 0.3);
}

TEST(PixelTracker, IsNotMovedByALampThatDims) {
  const auto dim = [](double u, double v) { return 0.6 * LampLight(u, v); };
  const Followed followed =
      Follow(TexturedPicture({0, 0}, LampLight), TexturedPicture({1.5, 0.5}, dim));
  const std::vector<double> errors = Errors(followed, {1.5, 0.5});
  ASSERT_FALSE(errors.empty());
  EXPECT_LT(Median(errors), 0.1);
}

// Returns the grey picture of tissue beside which, from column 80 on, something has this
// brightness.
std::vector<int> GrayBeside(double brightness, bool is_known) {
  const ColorImage image =
      TexturedPicture({0, 0}, [&](double u, double) { return u < 80.0 ? 0.5 : brightness; });
  MaskImage measured(image.width(), image.height(), 1);
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 80; u < image.width(); ++u) measured(u, v) = 0;
  }
  PixelTracker tracker(DenseCorners());
  tracker.SetImage(image, is_known ? measured : MaskImage());
  const ImageView<std::uint8_t> gray = tracker.Levels()[0];
  return {gray.pixels(), gray.pixels() + static_cast<std::ptrdiff_t>(gray.width()) * gray.height()};
}

TEST(PixelTracker, DoesNotShadeTissueByWhatIsBesideIt) {
  const auto difference = [](bool is_known) {
    const std::vector<int> dark = GrayBeside(0.02, is_known);
    const std::vector<int> bright = GrayBeside(1.0, is_known);
    int most = 0;
    for (std::size_t k = 0; k < dark.size(); ++k) {
      if (k % 160 < 80) most = std::max(most, std::abs(dark[k] - bright[k]));
    }
    return most;
  };
  EXPECT_LE(difference(true), 1);
  EXPECT_GT(difference(false), 20);
}

TEST(PixelTracker, IsTheSameWithAMaskThatHasEverything) {
  const ColorImage image = TexturedPicture({0, 0}, LampLight);
  PixelTracker with(DenseCorners());
  with.SetImage(image, MaskImage(image.width(), image.height(), 1));
  PixelTracker without(DenseCorners());
  without.SetImage(image);
  const ImageView<std::uint8_t> a = with.Levels()[0];
  const ImageView<std::uint8_t> b = without.Levels()[0];
  EXPECT_TRUE(std::equal(a.pixels(), a.pixels() + 160 * 120, b.pixels()));
}

TEST(PixelTracker, FlagsWhatIsCoveredOrOutOfThePicture) {
  const ColorImage first = TexturedPicture({0, 0}, EvenLight);
  ColorImage second = TexturedPicture({0, 0}, EvenLight);
  // The left third is covered by something smooth, and the right third by other tissue.
  const ColorImage other = TexturedPicture({0, 0}, EvenLight, 99);
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 160; ++u) {
      if (u < 55) second(u, v) = {90, 60, 50};
      if (u >= 105) second(u, v) = other(u, v);
    }
  }
  const Followed followed = Follow(first, second);
  int smooth = 0;
  int smooth_found = 0;
  int strange = 0;
  int strange_found = 0;
  int kept = 0;
  int kept_found = 0;
  for (std::size_t i = 0; i < followed.before.size(); ++i) {
    // The whole window lies in one of the three parts.
    const double u = followed.before[i].x();
    const bool found = followed.after[i].found;
    if (u < 40) ++smooth, smooth_found += found;
    if (u > 120) ++strange, strange_found += found;
    if (u > 70 && u < 90) ++kept, kept_found += found;
  }
  EXPECT_GT(std::min({smooth, strange, kept}), 10);
  EXPECT_EQ(smooth_found, 0);
  // Some corner of the other tissue is often near enough to be found, and found again in the
  // opposite direction.
  EXPECT_LE(strange_found, strange / 3);
  EXPECT_EQ(kept_found, kept);
}

TEST(PixelTracker, FindsNothingBeforeThereAreTwoPictures) {
  PixelTracker tracker(DenseCorners());
  EXPECT_TRUE(tracker.Track({}, {}).empty());
  tracker.SetImage(TexturedPicture({0, 0}, EvenLight));
  const std::vector<TrackedPixel> tracked = tracker.Track({{50.0, 50.0}}, {{50.0, 50.0}});
  ASSERT_EQ(tracked.size(), 1u);
  EXPECT_FALSE(tracked[0].found);
}

TEST(PixelTracker, DetectsCornersApartFromEachOtherWhereItMay) {
  PixelTracker tracker(DenseCorners());
  tracker.SetImage(TexturedPicture({0, 0}, EvenLight));
  MaskImage left(160, 120, 0);
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 80; ++u) left(u, v) = 1;
  }
  const std::vector<Eigen::Vector2d> taken = {{40.0, 60.0}, {20.0, 20.0}};
  const std::vector<Eigen::Vector2d> corners = tracker.Detect(left, taken, 500);
  EXPECT_GT(corners.size(), 30u);
  for (std::size_t a = 0; a < corners.size(); ++a) {
    EXPECT_LT(corners[a].x(), 80.0);
    for (std::size_t b = 0; b < a; ++b) EXPECT_GE((corners[a] - corners[b]).norm(), 6.0);
    for (const Eigen::Vector2d& t : taken) EXPECT_GT((corners[a] - t).norm(), 6.0);
  }
  EXPECT_EQ(tracker.Detect(left, taken, 7).size(), 7u);
  EXPECT_TRUE(tracker.Detect(left, taken, 0).empty());
  EXPECT_TRUE(tracker.Detect(MaskImage(160, 120, 0), {}, 10).empty());
}

TEST(PixelTracker, GivesTheSameBitsAgainAndOnAnyNumberOfThreads) {
  const ColorImage first = TexturedPicture({0, 0}, LampLight);
  const ColorImage second = TexturedPicture({1.3, -2.2}, LampLight);
  const Followed a = Follow(first, second);
  for (const int threads : {1, 2, 5}) {
    const Followed b = Follow(first, second, Eigen::Vector2d::Zero(), threads);
    ASSERT_EQ(a.before.size(), b.before.size());
    for (std::size_t i = 0; i < a.before.size(); ++i) {
      EXPECT_EQ(a.before[i], b.before[i]);
      EXPECT_EQ(a.after[i].pixel, b.after[i].pixel);
      EXPECT_EQ(a.after[i].found, b.after[i].found);
    }
  }
}

}  // namespace
}  // namespace ceres_ed
