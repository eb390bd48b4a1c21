#include "ceres_ed/simulation/texture.h"

#include <algorithm>
#include <cmath>

namespace ceres_ed {
namespace {

// The contrast of the mottles at each wavelength, in metres.
struct Mottle {
  double wavelength;
  double contrast;
};
constexpr Mottle kMottles[] = {
    {0.024, 0.9}, {0.010, 0.8}, {0.0045, 0.7}, {0.002, 0.6}, {0.0009, 0.5}, {0.00045, 0.4}};

// The half-width of a line in units of the noise that draws it; it is about 3 % of the spacing of
// the lines.
constexpr double kLineLevel = 0.05;

std::uint32_t Mix(std::uint32_t h) {
  h ^= h >> 16;
  h *= 0x7feb352dU;
  h ^= h >> 15;
  h *= 0x846ca68bU;
  return h ^ (h >> 16);
}

// Returns the noise near a corner of its grid: the offset from the corner times a slope. The upper
// bits of `hash` select one of sixteen directions for the slope.
double Slope(std::uint32_t hash, double x, double y, double z) {
  static constexpr double kDirections[16][3] = {{1, 1, 0},
                                                {-1, 1, 0},
                                                {1, -1, 0},
                                                {-1, -1, 0},
                                                {1, 0, 1},
                                                {-1, 0, 1},
                                                {1, 0, -1},
                                                {-1, 0, -1},
                                                {0, 1, 1},
                                                {0, -1, 1},
                                                {0, 1, -1},
                                                {0, -1, -1},
                                                {1, 1, 0},
                                                {0, -1, 1},
                                                {-1, 1, 0},
                                                {0, -1, -1}};
  const double* direction = kDirections[hash >> 28];
  return direction[0] * x + direction[1] * y + direction[2] * z;
}

// A fast floor: std::floor() is a function call unless the compiler may assume that the processor
// has an instruction for it.
std::int64_t Floor(double x) {
  const auto whole = static_cast<std::int64_t>(x);
  return static_cast<double>(whole) > x ? whole - 1 : whole;
}

double Fade(double t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); }

double Lerp(double t, double a, double b) { return a + t * (b - a); }

// Returns 1 if a wave is at least four pixels long, and 0 if it is shorter than two.
double Resolved(double wavelength, double pixel) {
  return std::clamp(0.5 * (wavelength / pixel - 2.0), 0.0, 1.0);
}

}  // namespace

SyntheticTexture::SyntheticTexture(std::uint64_t seed)
    : seed_(Mix(static_cast<std::uint32_t>(seed) ^ Mix(static_cast<std::uint32_t>(seed >> 32)))) {}

// Gradient noise, which is smooth, has mean 0, and rarely leaves [-1, 1].
double SyntheticTexture::Noise(const Eigen::Vector3d& rest,
                               double wavelength,
                               std::uint32_t layer) const {
  Eigen::Vector3d f = rest / wavelength;
  std::uint32_t hash[3][2];
  constexpr std::uint32_t kPrimes[3] = {73856093U, 19349663U, 83492791U};
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t floor = Floor(f[axis]);
    f[axis] -= static_cast<double>(floor);
    const auto cell = static_cast<std::uint32_t>(floor);
    hash[axis][0] = cell * kPrimes[axis];
    hash[axis][1] = (cell + 1U) * kPrimes[axis];
  }
  const std::uint32_t key = Mix(seed_ + layer);
  const auto corner = [&](int i, int j, int k) {
    std::uint32_t h = (hash[0][i] ^ hash[1][j] ^ hash[2][k] ^ key) * 0x7feb352dU;
    h = (h ^ (h >> 15)) * 0x846ca68bU;
    return Slope(h, f.x() - i, f.y() - j, f.z() - k);
  };
  const double u = Fade(f.x());
  const auto edge = [&](int j, int k) { return Lerp(u, corner(0, j, k), corner(1, j, k)); };
  const double v = Fade(f.y());
  const auto face = [&](int k) { return Lerp(v, edge(0, k), edge(1, k)); };
  return Lerp(Fade(f.z()), face(0), face(1));
}

// Returns 1 in the middle of a line and 0 away from it. The lines are the closed curves where a
// noise is zero.
double SyntheticTexture::Lines(const Eigen::Vector3d& rest, double spacing, double pixel) const {
  const double resolved = Resolved(4.0 * kLineLevel * spacing, pixel);
  if (resolved == 0.0) return 0.0;
  const double level = Noise(rest, spacing, static_cast<std::uint32_t>(1e6 * spacing)) / kLineLevel;
  return resolved * std::exp(-level * level);
}

Eigen::Vector3d SyntheticTexture::Color(const Eigen::Vector3d& rest, double pixel) const {
  const Eigen::Vector3d dark(0.50, 0.16, 0.15);
  const Eigen::Vector3d pale(0.98, 0.66, 0.58);
  const Eigen::Vector3d wine(0.30, 0.05, 0.09);
  double tone = 0.5;
  std::uint32_t layer = 0;
  for (const auto& [wavelength, contrast] : kMottles) {
    ++layer;
    const double strength = contrast * Resolved(wavelength, pixel);
    if (strength > 0.0) tone += 0.5 * strength * Noise(rest, wavelength, layer);
  }
  const Eigen::Vector3d tissue = dark + std::clamp(tone, 0.0, 1.0) * (pale - dark);
  const double vessel = std::max(Lines(rest, 0.018, pixel), 0.8 * Lines(rest, 0.007, pixel));
  return tissue + 0.8 * vessel * (wine - tissue);
}

}  // namespace ceres_ed
