#include <ceres_ed/slam/frame/window_sums.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// Returns a rough slope with a jump, with holes and with values that are not depths.
DepthImage RoughDepth(int width, int height) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> noise(-0.004F, 0.004F);
  DepthImage depth(width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      depth(u, v) = 0.3F + 0.001F * u + (v > height / 2 ? 0.1F : 0.0F) + noise(random);
      if (random() % 40 == 0) depth(u, v) = 0.0F;
    }
  }
  depth(3, 2) = std::numeric_limits<float>::quiet_NaN();
  depth(5, 7) = std::numeric_limits<float>::infinity();
  depth(8, 4) = -1.0F;
  // In a sum of inverses this value drowns all others.
  depth(6, 5) = 1e-9F;
  return depth;
}

// The sums, computed pixel by pixel.
struct Sums {
  double n = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0, q = 0, uq = 0, vq = 0, qq = 0;
};

Sums SumPlainly(const DepthImage& depth, int u0, int v0, const WindowOptions& options) {
  Sums s;
  const double z0 = depth(u0, v0);
  if (!(z0 > 0.0) || !std::isfinite(z0)) return s;
  for (int v = v0 - options.radius; v <= v0 + options.radius; ++v) {
    for (int u = u0 - options.radius; u <= u0 + options.radius; ++u) {
      if (!depth.Contains(u, v)) continue;
      const double z = depth(u, v), du = u - u0, dv = v - v0;
      const double steps = std::max({std::abs(du), std::abs(dv), 1.0});
      if (!(z > 0.0) || !(std::abs(z - z0) <= options.max_step * steps * z0)) continue;
      const double q = z0 / z;
      s.n += 1;
      s.u += du;
      s.v += dv;
      s.uu += du * du;
      s.uv += du * dv;
      s.vv += dv * dv;
      s.q += q;
      s.uq += du * q;
      s.vq += dv * q;
      s.qq += q * q;
    }
  }
  return s;
}

void ExpectPlainSums(const DepthImage& depth, const WindowOptions& options) {
  SCOPED_TRACE(testing::Message() << "cell " << options.cell << ", radius " << options.radius
                                  << ", width " << depth.width());
  WindowSummer summer(depth, options);
  ASSERT_EQ(summer.count(), (depth.width() + options.cell - 1) / options.cell);
  // In ascending order, and then from the start again.
  for (const int v0 : {0, 1, 2, 5, 9, depth.height() / 2, depth.height() - 1, 4}) {
    const WindowSums& sums = summer.SumRow(v0);
    for (int i = 0; i < summer.count(); ++i) {
      const int u0 = std::min(i * options.cell + options.cell / 2, depth.width() - 1);
      const Sums s = SumPlainly(depth, u0, v0, options);
      ASSERT_EQ(sums.n[i], s.n) << u0 << " " << v0;
      EXPECT_EQ(sums.u[i], s.u);
      EXPECT_EQ(sums.v[i], s.v);
      EXPECT_EQ(sums.uu[i], s.uu);
      EXPECT_EQ(sums.uv[i], s.uv);
      EXPECT_EQ(sums.vv[i], s.vv);
      const double rounding = 1e-14 * (1.0 + s.n * options.radius) * std::max(1.0, s.qq);
      EXPECT_NEAR(sums.q[i], s.q, rounding);
      EXPECT_NEAR(sums.uq[i], s.uq, rounding);
      EXPECT_NEAR(sums.vq[i], s.vq, rounding);
      EXPECT_NEAR(sums.qq[i], s.qq, rounding);
      EXPECT_EQ(summer.IsFull(i), s.n == summer.full_count());
      if (summer.IsFull(i)) EXPECT_EQ(s.uu, summer.full_square());
    }
  }
}

TEST(WindowSummer, SumsAsPixelByPixel) {
  WindowOptions options;
  options.max_step = 0.02;
  for (const int width : {9, 41, 160}) {
    const DepthImage depth = RoughDepth(width, 24);
    for (options.cell = 1; options.cell <= 5; ++options.cell) {
      for (const int radius : {1, 2, 3, 4, 7}) {
        options.radius = radius;
        ExpectPlainSums(depth, options);
      }
    }
  }
}

TEST(WindowSummer, TakesAnyDepthWhereStepsHaveNoBound) {
  WindowOptions options;
  options.max_step = 1e3;
  ExpectPlainSums(RoughDepth(50, 20), options);
}

TEST(WindowSummer, GivesTheSameBytesWhicheverRowsWereReadBefore) {
  const DepthImage depth = RoughDepth(60, 24);
  WindowOptions options;
  options.max_step = 0.02;
  WindowSummer after(depth, options);
  for (int v = 0; v < 11; ++v) after.SumRow(v);
  WindowSummer alone(depth, options);
  EXPECT_EQ(after.SumRow(11).qq, alone.SumRow(11).qq);
  EXPECT_EQ(after.SumRow(4).uq, alone.SumRow(4).uq);
}

TEST(WindowSummer, TakesPicturesSmallerThanAWindow) {
  DepthImage depth(3, 2, 0.5F);
  WindowOptions options;
  WindowSummer summer(depth, options);
  const WindowSums& sums = summer.SumRow(1);
  EXPECT_EQ(summer.count(), 2);
  EXPECT_EQ(sums.n[0], 6.0);
  EXPECT_EQ(sums.n[1], 6.0);
  EXPECT_EQ(sums.v[0], -3.0);
  EXPECT_EQ(sums.u[0], 0.0);
  EXPECT_EQ(sums.u[1], -6.0);
}

}  // namespace
}  // namespace ceres_ed
