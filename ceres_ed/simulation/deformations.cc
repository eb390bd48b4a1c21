#include "ceres_ed/simulation/deformations.h"

#include <algorithm>
#include <cmath>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// Returns a cubic step that rises from 0 to 1 over [0, 1].
double Step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// A bend in the plane of s (along the body) and h (across it, toward the inside of the bend). It
// changes nothing before `start` and is rigid from start + width on, where it has turned by `angle`
// radians. Lengths along h = 0 are preserved.
struct Bend {
  double start;
  double width;
  double angle;
};

void ApplyBend(const Bend& bend, double* s, double* h) {
  const double along = *s - bend.start;
  if (along <= 0.0) return;
  const auto turn = [&bend](double u) { return bend.angle * Step(u / bend.width); };
  // Simpson's rule integrates the curved part; the rest is straight.
  constexpr int kIntervals = 32;
  const double curved = std::min(along, bend.width);
  double x = 0.0;
  double y = 0.0;
  for (int k = 0; k <= kIntervals; ++k) {
    const double weight = k == 0 || k == kIntervals ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
    const double theta = turn(curved * k / kIntervals);
    x += weight * std::cos(theta);
    y += weight * std::sin(theta);
  }
  const double theta = turn(along);
  const double scale = curved / (3.0 * kIntervals);
  const double straight = along - curved;
  const double across = *h;
  *s = bend.start + x * scale + straight * std::cos(theta) - across * std::sin(theta);
  *h = y * scale + straight * std::sin(theta) + across * std::cos(theta);
}

// Applies a bend of constant curvature about s = 0.
void ApplyArc(double curvature, double* s, double* h) {
  const double theta = curvature * *s;
  // The circle of a body that is nearly straight has a centre so far away that its digits would be
  // lost; the first order is exact there.
  constexpr double kNearlyStraight = 1e-7;
  if (std::abs(curvature) < kNearlyStraight) {
    const double across = *h;
    *h += 0.5 * theta * *s;
    *s -= theta * across;
    return;
  }
  const double radius = 1.0 / curvature - *h;
  *s = radius * std::sin(theta);
  *h = 1.0 / curvature - radius * std::cos(theta);
}

double Gaussian(double squared_distance, double sigma) {
  return std::exp(-squared_distance / (2.0 * sigma * sigma));
}

Eigen::Vector3d DeformPlane(double phase, Eigen::Vector3d p) {
  // x and y of the centre, height and width of each bump.
  constexpr double kBumps[6][4] = {{-0.22, -0.18, 0.060, 0.14},
                                   {0.20, -0.24, -0.045, 0.13},
                                   {0.02, 0.03, 0.050, 0.13},
                                   {-0.27, 0.24, -0.040, 0.12},
                                   {0.26, 0.20, 0.060, 0.15},
                                   {0.00, 0.38, 0.025, 0.11}};
  for (const auto& [x, y, height, sigma] : kBumps) {
    p.z() += phase * height * Gaussian((p.head<2>() - Eigen::Vector2d(x, y)).squaredNorm(), sigma);
  }
  return p;
}

Eigen::Vector3d DeformDolphin(double phase, Eigen::Vector3d p) {
  // Tail, where s runs backward. The sideways bend comes first, while y and z are still those of
  // the straight body.
  double s = -p.x();
  ApplyBend({-0.12, 0.66, 1.40 * phase}, &s, &p.y());
  double h = -p.z();
  ApplyBend({0.10, 0.42, 0.60 * phase}, &s, &h);
  p.x() = -s;
  p.z() = -h;
  // Head.
  s = p.x();
  ApplyBend({0.18, 0.32, 0.45 * phase}, &s, &p.y());
  h = -p.z();
  ApplyBend({0.18, 0.32, 0.35 * phase}, &s, &h);
  p.x() = s;
  p.z() = -h;
  return p;
}

Eigen::Vector3d DeformHeart(double phase, Eigen::Vector3d p) {
  constexpr double kBase = 0.30;
  constexpr double kApex = -0.47;
  const Eigen::Vector2d axis(0.06, 0.0);
  const double twist = 0.24 * phase * Step((kBase - p.z()) / (kBase - kApex));
  const double squeeze = 1.0 - 0.10 * phase * Gaussian((p.z() + 0.08) * (p.z() + 0.08), 0.25);
  const Eigen::Vector2d across = squeeze * (p.head<2>() - axis);
  p.x() = axis.x() + std::cos(twist) * across.x() - std::sin(twist) * across.y();
  p.y() = axis.y() + std::sin(twist) * across.x() + std::cos(twist) * across.y();
  p.z() = kBase + (1.0 - 0.06 * phase) * (p.z() - kBase);
  return p;
}

Eigen::Vector3d DeformKidney(double phase, Eigen::Vector3d p) {
  const Eigen::Vector3d tip(-0.07, -0.17, 0.06);
  p.y() += 0.08 * phase * Gaussian((p - tip).squaredNorm(), 0.15);
  ApplyArc(0.5 * phase, &p.z(), &p.x());
  // Breathing carries the organ down, and a little to the front.
  return p + phase * Eigen::Vector3d(0.01, -0.02, -0.05);
}

Eigen::Vector3d DeformStomach(double phase, Eigen::Vector3d p) {
  const Eigen::Vector3d offset = p - Eigen::Vector3d(0.20, 0.0, 0.04);
  p += phase * 0.30 * Gaussian(offset.squaredNorm(), 0.17) * offset;
  // The antrum, whose axis lies at z = -0.28, swings up and to the front.
  double s = -p.x();
  double h = p.z() + 0.28;
  ApplyBend({0.08, 0.30, 0.35 * phase}, &s, &h);
  p.z() = h - 0.28;
  h = -p.y();
  ApplyBend({0.08, 0.30, 0.25 * phase}, &s, &h);
  p.x() = -s;
  p.y() = -h;
  return p;
}

}  // namespace

Eigen::Vector3d DeformSyntheticPoint(SyntheticShape shape,
                                     double size,
                                     double phase,
                                     const Eigen::Vector3d& point) {
  CHECK_GT(size, 0.0);
  CHECK(phase >= 0.0 && phase <= 1.0) << "phase " << phase;
  const Eigen::Vector3d unit = point / size;
  switch (shape) {
    case SyntheticShape::kPlane:
      return size * DeformPlane(phase, unit);
    case SyntheticShape::kDolphin:
      return size * DeformDolphin(phase, unit);
    case SyntheticShape::kHeart:
      return size * DeformHeart(phase, unit);
    case SyntheticShape::kKidney:
      return size * DeformKidney(phase, unit);
    case SyntheticShape::kStomach:
      return size * DeformStomach(phase, unit);
  }
  LOG(FATAL) << "shape " << static_cast<int>(shape);
  return point;
}

PointCloud DeformSyntheticShape(SyntheticShape shape,
                                double size,
                                double phase,
                                const PointCloud& cloud) {
  PointCloud deformed;
  deformed.triangles = cloud.triangles;
  deformed.intensities = cloud.intensities;
  deformed.points.reserve(cloud.size());
  for (const Eigen::Vector3d& point : cloud.points) {
    deformed.points.push_back(DeformSyntheticPoint(shape, size, phase, point));
  }
  return deformed;
}

}  // namespace ceres_ed
