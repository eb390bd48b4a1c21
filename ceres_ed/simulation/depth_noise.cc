// Adds the errors of a depth camera to a rendered image (AddDepthNoise() of rendering.h).
#include <ceres_ed/simulation/rendering.h>
#include <ceres_ed/util/random.h>

#include <algorithm>
#include <cmath>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// All pixels with a cosine of kDropOutAll or less drop out; no pixel with a cosine of kDropOutNone
// or more does.
constexpr double kDropOutAll = 0.1;
constexpr double kDropOutNone = 0.35;

// Binomial weights of the smoothing filter; the sum of their squares is the variance of the
// filtered noise.
constexpr int kReach = 2;
constexpr double kWeights[2 * kReach + 1] = {1.0, 4.0, 6.0, 4.0, 1.0};
constexpr double kSumOfSquares = 70.0;

Image<float> WhiteNoise(int width, int height, Random* random) {
  Image<float> noise(width, height);
  for (float& value : noise.pixels()) value = static_cast<float>(random->Gaussian());
  return noise;
}

// Turns independent numbers of variance 1 into correlated numbers of variance 1. The result is
// smaller than the input by kReach on each side.
Image<float> Smooth(const Image<float>& white) {
  const double scale = 1.0 / std::sqrt(kSumOfSquares);
  Image<float> rows(white.width() - 2 * kReach, white.height());
  for (int v = 0; v < rows.height(); ++v) {
    for (int u = 0; u < rows.width(); ++u) {
      double sum = 0.0;
      for (int k = 0; k <= 2 * kReach; ++k)
        sum += kWeights[k] * static_cast<double>(white(u + k, v));
      rows(u, v) = static_cast<float>(scale * sum);
    }
  }
  Image<float> smooth(rows.width(), rows.height() - 2 * kReach);
  for (int v = 0; v < smooth.height(); ++v) {
    for (int u = 0; u < smooth.width(); ++u) {
      double sum = 0.0;
      for (int k = 0; k <= 2 * kReach; ++k)
        sum += kWeights[k] * static_cast<double>(rows(u, v + k));
      smooth(u, v) = static_cast<float>(scale * sum);
    }
  }
  return smooth;
}

}  // namespace

void AddDepthNoise(const DepthNoise& noise,
                   std::uint64_t seed,
                   const Image<float>& cosines,
                   DepthImage* depth) {
  CHECK(cosines.width() == depth->width() && cosines.height() == depth->height());
  if (!noise.known() || depth->empty()) return;
  Random random(seed);
  const Image<float> own = WhiteNoise(depth->width(), depth->height(), &random);
  const Image<float> shared =
      Smooth(WhiteNoise(depth->width() + 2 * kReach, depth->height() + 2 * kReach, &random));
  for (int v = 0; v < depth->height(); ++v) {
    for (int u = 0; u < depth->width(); ++u) {
      // A number is drawn for every pixel, so that the errors of later pixels do not depend on
      // which pixels see something.
      const double chance = random.Uniform();
      float& value = (*depth)(u, v);
      if (value == 0.0F) continue;
      const double cosine = static_cast<double>(cosines(u, v));
      if (chance * (kDropOutNone - kDropOutAll) < kDropOutNone - cosine) {
        value = 0.0F;
        continue;
      }
      const double unit = std::sqrt(0.5) * static_cast<double>(own(u, v) + shared(u, v));
      const double sigma = noise.At(static_cast<double>(value));
      const double error = sigma / std::max(cosine, kDropOutAll) * unit;
      value = static_cast<float>(std::max(0.0, static_cast<double>(value) + error));
    }
  }
}

}  // namespace ceres_ed
