#include "ceres_ed/slam/frame/patch_template.h"

#include <ceres_ed/util/random.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// A pattern of waves of many lengths and directions, which does not repeat nearby.
double Pattern(const Eigen::Vector2d& x) {
  static const std::vector<Eigen::Vector3d> waves = [] {
    Random random(7);
    std::vector<Eigen::Vector3d> all;
    for (int k = 0; k < 30; ++k) {
      const double angle = 2.0 * M_PI * random.Uniform();
      const double frequency = 2.0 * M_PI / (6.0 + 24.0 * random.Uniform());
      all.emplace_back(
          frequency * std::cos(angle), frequency * std::sin(angle), 2.0 * M_PI * random.Uniform());
    }
    return all;
  }();
  double sum = 0.0;
  for (const Eigen::Vector3d& wave : waves) sum += std::sin(wave.head<2>().dot(x) + wave.z());
  return 128.0 + 10.0 * sum;
}

// A picture in which the pixel q shows the place `place(q)` of the pattern, and its half.
struct Picture {
  template <typename Place>
  explicit Picture(const Place& place, double gain = 1.0, double offset = 0.0)
      : full(120, 100), half(60, 50) {
    for (int level = 0; level < 2; ++level) {
      Image<std::uint8_t>& image = level == 0 ? full : half;
      for (int v = 0; v < image.height(); ++v) {
        for (int u = 0; u < image.width(); ++u) {
          const double value = Pattern(place(Eigen::Vector2d(u, v) * (1 << level)));
          image(u, v) =
              static_cast<std::uint8_t>(std::lround(std::clamp(gain * value + offset, 0.0, 255.0)));
        }
      }
    }
  }
  GrayLevels levels() const { return {full, half}; }

  Image<std::uint8_t> full;
  Image<std::uint8_t> half;
};

PatchTemplate CutAt(const Eigen::Vector2d& pixel) {
  const Picture picture([](const Eigen::Vector2d& q) { return q; });
  PatchTemplate patch;
  EXPECT_TRUE(PatchTemplate::Cut(picture.levels(), pixel, &patch));
  return patch;
}

TEST(PatchTemplate, IsFoundWhereThePictureHasMoved) {
  const Eigen::Vector2d place(60.0, 50.0);
  const PatchTemplate patch = CutAt(place);
  const Eigen::Vector2d shift(4.3, -2.6);
  const Picture now([&](const Eigen::Vector2d& q) { return q - shift; });
  const PatchMatch match =
      FindPatch(patch, now.levels(), place, Eigen::Matrix2d::Identity(), /*reach=*/8.0);
  EXPECT_LT((match.pixel - place - shift).norm(), 0.05);
  EXPECT_GT(match.correlation, 0.99);
}

TEST(PatchTemplate, IsFoundWithoutASearchIfTheStartIsNear) {
  const Eigen::Vector2d place(60.0, 50.0);
  const PatchTemplate patch = CutAt(place);
  const Eigen::Vector2d shift(0.9, 0.7);
  const Picture now([&](const Eigen::Vector2d& q) { return q - shift; });
  const PatchMatch match =
      FindPatch(patch, now.levels(), place, Eigen::Matrix2d::Identity(), /*reach=*/0.0);
  EXPECT_LT((match.pixel - place - shift).norm(), 0.05);
}

TEST(PatchTemplate, IsFoundInAPictureThatIsTurnedAndStretched) {
  const Eigen::Vector2d place(60.0, 50.0);
  const PatchTemplate patch = CutAt(place);
  const Eigen::Matrix2d now_from_then =
      Eigen::Rotation2Dd(0.4).toRotationMatrix() * Eigen::Vector2d(1.3, 0.8).asDiagonal();
  const Eigen::Matrix2d back = now_from_then.inverse();
  const Eigen::Vector2d shift(2.4, 1.1);
  const Picture now([&](const Eigen::Vector2d& q) {
    return Eigen::Vector2d(place + back * (q - place - shift));
  });
  const PatchMatch match = FindPatch(patch, now.levels(), place, now_from_then, /*reach=*/6.0);
  EXPECT_LT((match.pixel - place - shift).norm(), 0.1);
  EXPECT_GT(match.correlation, 0.97);
}

TEST(PatchTemplate, DoesNotMindTheBrightness) {
  const Eigen::Vector2d place(60.0, 50.0);
  const PatchTemplate patch = CutAt(place);
  const Picture now([](const Eigen::Vector2d& q) { return q; }, 0.5, 40.0);
  const PatchMatch match =
      FindPatch(patch, now.levels(), place, Eigen::Matrix2d::Identity(), /*reach=*/0.0);
  EXPECT_LT((match.pixel - place).norm(), 0.05);
  EXPECT_GT(match.correlation, 0.99);
}

TEST(PatchTemplate, IsNotFoundWhereNothingIs) {
  const PatchTemplate patch = CutAt({60.0, 50.0});
  const Picture flat([](const Eigen::Vector2d&) { return Eigen::Vector2d(3.0, 7.0); });
  EXPECT_LT(
      FindPatch(patch, flat.levels(), {60.0, 50.0}, Eigen::Matrix2d::Identity(), 8.0).correlation,
      0.0);
}

// Stripes and checks look the same a period farther.
TEST(PatchTemplate, IsNotFoundInAPatternThatRepeats) {
  const auto checks = [](const Eigen::Vector2d& q) {
    constexpr double kPeriod = 12.0;
    const auto fold = [](double x) { return 8.0 * std::cos(2.0 * M_PI * x / kPeriod); };
    return Eigen::Vector2d(fold(q.x()), fold(q.y()));
  };
  const Picture picture(checks);
  PatchTemplate patch;
  ASSERT_TRUE(PatchTemplate::Cut(picture.levels(), {60.0, 50.0}, &patch));
  const auto find = [&](double reach) {
    return FindPatch(patch, picture.levels(), {60.3, 50.2}, Eigen::Matrix2d::Identity(), reach);
  };
  EXPECT_LT(find(12.0).correlation, 0.0);
  // Without a search there is no doubt.
  EXPECT_LT((find(0.0).pixel - Eigen::Vector2d(60.0, 50.0)).norm(), 0.05);
}

// Returns a picture whose right part, from column 64 on, is moved in another way than the rest.
Picture TwoSurfaces(const Eigen::Vector2d& left_shift, const Eigen::Vector2d& right_shift) {
  return Picture([&](const Eigen::Vector2d& q) {
    return Eigen::Vector2d(q - (q.x() < 64.0 ? left_shift : right_shift));
  });
}

TEST(PatchTemplate, IsNotPulledByWhatMovesBeyondTheRimOfItsSurface) {
  const Eigen::Vector2d place(60.0, 50.0);
  const Eigen::Vector2d far(300.0, 0.0);
  PatchTemplate whole;
  ASSERT_TRUE(PatchTemplate::Cut(TwoSurfaces({0, 0}, far).levels(), place, &whole));
  PatchTemplate kept = whole;
  const double share = kept.Keep(place, [](const Eigen::Vector2d& q) { return q.x() < 64.0; });
  EXPECT_NEAR(share, 11.0 / 15.0, 1e-12);
  const Eigen::Vector2d shift(0.4, 0.3);
  const auto find = [&](const PatchTemplate& patch, double reach) {
    const Picture now = TwoSurfaces(shift, far + Eigen::Vector2d(2.5, -3.0));
    return FindPatch(patch, now.levels(), place, Eigen::Matrix2d::Identity(), reach);
  };
  for (const double reach : {0.0, 6.0}) {
    const PatchMatch match = find(kept, reach);
    EXPECT_LT((match.pixel - place - shift).norm(), 0.05);
    EXPECT_GT(match.correlation, 0.97);
  }
  EXPECT_GT((find(whole, 0.0).pixel - place - shift).norm(), 0.1);
}

TEST(PatchTemplate, ShowsNothingIfLittleOfItIsLeft) {
  PatchTemplate patch = CutAt({60.0, 50.0});
  patch.Keep({60.0, 50.0}, [](const Eigen::Vector2d& q) { return q.x() < 56.0; });
  const Picture same([](const Eigen::Vector2d& q) { return q; });
  EXPECT_LT(
      FindPatch(patch, same.levels(), {60.0, 50.0}, Eigen::Matrix2d::Identity(), 4.0).correlation,
      0.0);
}

TEST(PatchTemplate, IsNotCutOrFoundAtTheBorder) {
  const Picture picture([](const Eigen::Vector2d& q) { return q; });
  PatchTemplate patch;
  EXPECT_FALSE(PatchTemplate::Cut(picture.levels(), {5.0, 50.0}, &patch));
  EXPECT_FALSE(PatchTemplate::Cut(picture.levels(), {60.0, 97.0}, &patch));
  // The half picture needs twice the room.
  EXPECT_FALSE(PatchTemplate::Cut(picture.levels(), {10.0, 50.0}, &patch));
  patch = CutAt({60.0, 50.0});
  EXPECT_LT(
      FindPatch(patch, picture.levels(), {2.0, 2.0}, Eigen::Matrix2d::Identity(), 0.0).correlation,
      0.0);
}

}  // namespace
}  // namespace ceres_ed
