#include "ceres_ed/simulation/solid.h"

#include <algorithm>
#include <cmath>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr int kSamplesPerSegment = 8;
// The step of the central differences, in the unit of the solid (whose size is about 1).
constexpr double kStep = 1e-4;

// Evaluates a uniform Catmull-Rom spline. A centripetal spline would be safer for unevenly spaced
// control points, but ours are evenly spaced.
Eigen::Vector4d CatmullRom(const std::vector<Eigen::Vector4d>& balls, int segment, double t) {
  const int last = static_cast<int>(balls.size()) - 1;
  const Eigen::Vector4d& p1 = balls[segment];
  const Eigen::Vector4d& p2 = balls[segment + 1];
  const Eigen::Vector4d p0 = segment > 0 ? balls[segment - 1] : Eigen::Vector4d(2.0 * p1 - p2);
  const Eigen::Vector4d p3 =
      segment + 2 <= last ? balls[segment + 2] : Eigen::Vector4d(2.0 * p2 - p1);
  return 0.5 * (2.0 * p1 + t * (p2 - p0) + t * t * (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3) +
                t * t * t * (3.0 * (p1 - p2) + p3 - p0));
}

// Returns the signed distance to the convex hull of two balls; if one ball contains the other, to
// the nearer ball.
double RoundCone(const Eigen::Vector3d& point,
                 const Eigen::Vector3d& a,
                 const Eigen::Vector3d& b,
                 double radius_a,
                 double radius_b) {
  const Eigen::Vector3d axis = b - a;
  const Eigen::Vector3d offset = point - a;
  const double length = axis.norm();
  const double difference = radius_a - radius_b;
  if (length <= std::abs(difference) + 1e-12) {
    return std::min(offset.norm() - radius_a, (point - b).norm() - radius_b);
  }
  const double along = offset.dot(axis) / length;
  const double across = std::sqrt(std::max(0.0, offset.squaredNorm() - along * along));
  // The hull touches the balls where the generating line, which is tilted by asin(sine), leaves
  // them.
  const double sine = difference / length;
  const double cosine = std::sqrt(1.0 - sine * sine);
  const double foot = along - across * sine / cosine;
  if (foot <= 0.0) return offset.norm() - radius_a;
  if (foot >= length) return (point - b).norm() - radius_b;
  return across * cosine + along * sine - radius_a;
}

double SmoothMin(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - h * h * width * 0.25;
}

}  // namespace

void SyntheticSolid::Add(const SolidTube& tube) {
  CHECK(!tube.balls.empty());
  CHECK(tube.flatness > 0.0 && tube.flatness <= 1.0) << tube.flatness;
  Chain chain;
  chain.thin_axis = tube.thin_axis.normalized();
  chain.stretch = 1.0 / tube.flatness;
  chain.carve = tube.carve;
  std::vector<Eigen::Vector4d> samples;
  for (int segment = 0; segment + 1 < static_cast<int>(tube.balls.size()); ++segment) {
    for (int k = 0; k < kSamplesPerSegment; ++k) {
      samples.push_back(
          CatmullRom(tube.balls, segment, static_cast<double>(k) / kSamplesPerSegment));
    }
  }
  samples.push_back(tube.balls.back());
  chain.bound_center.setZero();
  for (const Eigen::Vector4d& ball : samples) {
    CHECK_GT(ball[3], 0.0);
    chain.bound_center += ball.head<3>() / static_cast<double>(samples.size());
  }
  chain.bound_radius = 0.0;
  for (const Eigen::Vector4d& ball : samples) {
    const Eigen::Vector3d center = ball.head<3>();
    chain.bound_radius =
        std::max(chain.bound_radius, (center - chain.bound_center).norm() + ball[3]);
    chain.centers.push_back(center +
                            (chain.stretch - 1.0) * chain.thin_axis.dot(center) * chain.thin_axis);
    chain.radii.push_back(ball[3]);
  }
  for (std::size_t k = 0; k + 1 < chain.centers.size(); ++k) {
    chain.reaches.push_back((chain.centers[k + 1] - chain.centers[k]).norm() +
                            std::max(chain.radii[k], chain.radii[k + 1]));
  }
  chains_.push_back(std::move(chain));
}

double SyntheticSolid::Distance(const Chain& chain, const Eigen::Vector3d& point) const {
  const Eigen::Vector3d stretched =
      point + (chain.stretch - 1.0) * chain.thin_axis.dot(point) * chain.thin_axis;
  double best = (stretched - chain.centers[0]).norm() - chain.radii[0];
  std::size_t nearest = 0;
  for (std::size_t k = 0; k + 1 < chain.centers.size(); ++k) {
    const double reach = best + chain.reaches[k];
    if (reach > 0.0 && (stretched - chain.centers[k]).squaredNorm() > reach * reach) continue;
    const double distance = RoundCone(
        stretched, chain.centers[k], chain.centers[k + 1], chain.radii[k], chain.radii[k + 1]);
    if (distance < best) {
      best = distance;
      nearest = k;
    }
  }
  if (chain.stretch == 1.0) return best;
  // To first order, a length in the stretched frame divided by the norm of the gradient is a length
  // in the frame of the solid. The gradient is M^T n, where n is the direction away from the axis
  // of the chain.
  const Eigen::Vector3d& a = chain.centers[nearest];
  const Eigen::Vector3d& b = chain.centers[std::min(nearest + 1, chain.centers.size() - 1)];
  const double squared = (b - a).squaredNorm();
  const double t = squared > 0.0 ? std::clamp((stretched - a).dot(b - a) / squared, 0.0, 1.0) : 0.0;
  Eigen::Vector3d normal = stretched - (a + t * (b - a));
  const double norm = normal.norm();
  if (norm < 1e-12) return best / chain.stretch;
  normal /= norm;
  return best /
         (normal + (chain.stretch - 1.0) * chain.thin_axis.dot(normal) * chain.thin_axis).norm();
}

double SyntheticSolid::Value(const Eigen::Vector3d& point) const {
  CHECK(!chains_.empty());
  double value = Distance(chains_[0], point);
  for (std::size_t k = 1; k < chains_.size(); ++k) {
    const Chain& chain = chains_[k];
    const double sign = chain.carve ? -1.0 : 1.0;
    // Beyond the fillet, a tube changes nothing.
    const double least = (point - chain.bound_center).norm() - chain.bound_radius;
    if (least >= sign * value + blend_) continue;
    value = sign * SmoothMin(sign * value, Distance(chain, point), blend_);
  }
  return value;
}

Eigen::Vector3d SyntheticSolid::Gradient(const Eigen::Vector3d& point) const {
  Eigen::Vector3d gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
    gradient[axis] = (Value(point + step) - Value(point - step)) / (2.0 * kStep);
  }
  return gradient;
}

Eigen::Vector3d SyntheticSolid::Project(const Eigen::Vector3d& point) const {
  Eigen::Vector3d projected = point;
  for (int iteration = 0; iteration < 6; ++iteration) {
    const double value = Value(projected);
    if (std::abs(value) < 1e-9) break;
    const Eigen::Vector3d gradient = Gradient(projected);
    // The gradient vanishes at a ridge of the distance; a lower bound keeps the step finite.
    projected -= value / std::max(gradient.squaredNorm(), 0.25) * gradient;
  }
  return projected;
}

std::pair<Eigen::Vector3d, Eigen::Vector3d> SyntheticSolid::Bounds() const {
  CHECK(!chains_.empty());
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(1e30);
  Eigen::Vector3d upper = -lower;
  for (const Chain& chain : chains_) {
    if (chain.carve) continue;
    for (std::size_t k = 0; k < chain.centers.size(); ++k) {
      const Eigen::Vector3d center = chain.centers[k] - (1.0 - 1.0 / chain.stretch) *
                                                            chain.thin_axis.dot(chain.centers[k]) *
                                                            chain.thin_axis;
      lower = lower.cwiseMin((center.array() - chain.radii[k]).matrix());
      upper = upper.cwiseMax((center.array() + chain.radii[k]).matrix());
    }
  }
  return {(lower.array() - blend_).matrix(), (upper.array() + blend_).matrix()};
}

}  // namespace ceres_ed
