#include "ceres_ed/simulation/shape_family.h"

#include <ceres_ed/simulation/shapes.h>
#include <ceres_ed/util/random.h>

#include <algorithm>
#include <cmath>

namespace ceres_ed {
namespace {

// Standard deviations of b_k: how far an end of the body moves, as a part of its length.
constexpr ShapeFamily::Amplitudes kDeviations = {0.07, 0.045, 0.03};
// The largest rotation of a shape against the template.
constexpr double kMaxAngle = 0.25;
constexpr int kMeshes = 5;
// A shape has from this part of the template's vertices on.
constexpr double kFewestVertices = 0.75;
constexpr double kMoreVertices = 0.09;

// Returns u_k at a point, in the unit of the body's length. The body lies along x, from -1/2 to
// 1/2. The first component is the rotation of the cross-sections that keeps them at a right angle
// to the bent axis.
Eigen::Vector3d Mode(int k, const Eigen::Vector3d& point) {
  const double x = point.x();
  const double tail = std::min(0.0, x);
  switch (k) {
    case 0:
      return {-8.0 * x * point.y(), 4.0 * x * x, 0.0};
    case 1:
      return {-(24.0 * x * x - 2.0) * point.y(), 8.0 * x * x * x - 2.0 * x, 0.0};
    default:
      return {-8.0 * tail * point.z(), 0.0, 4.0 * tail * tail};
  }
}

Similarity RandomPose(double size, Random* random) {
  Similarity pose;
  const Eigen::Vector3d axis(random->Gaussian(), random->Gaussian(), random->Gaussian());
  pose.rotation = Eigen::AngleAxisd(kMaxAngle * random->Uniform(), axis.normalized());
  for (int i = 0; i < 3; ++i) pose.translation[i] = size * random->Gaussian();
  return pose;
}

}  // namespace

ShapeFamily::ShapeFamily(const ShapeFamilyOptions& options) : options_(options) {
  source_ = MakeSyntheticShape(SyntheticShape::kDolphin, options.vertices, options.size);
  for (int m = 0; m < std::min(kMeshes, options.shapes); ++m) {
    const double share = kFewestVertices + kMoreVertices * m;
    const int vertices = std::max(500, static_cast<int>(share * options.vertices));
    meshes_.push_back(MakeSyntheticShape(SyntheticShape::kDolphin, vertices, options.size));
  }
  Random random(options.seed);
  for (int i = 0; i < options.shapes; ++i) {
    Amplitudes amplitudes;
    for (int k = 0; k < kModes; ++k) amplitudes[k] = kDeviations[k] * random.Gaussian();
    if (options.groups && i >= options.shapes / 2) amplitudes[0] += 2.0 * kDeviations[0];
    amplitudes_.push_back(amplitudes);
    poses_.push_back(RandomPose(options.size, &random));
  }
}

std::vector<Eigen::Vector3d> ShapeFamily::Deform(int shape,
                                                 const std::vector<Eigen::Vector3d>& points) const {
  std::vector<Eigen::Vector3d> moved;
  moved.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    Eigen::Vector3d at = point;
    for (int k = 0; k < kModes; ++k) {
      at += options_.size * amplitudes_[shape][k] * Mode(k, point / options_.size);
    }
    moved.push_back(poses_[shape] * at);
  }
  return moved;
}

PointCloud ShapeFamily::Shape(int shape) const {
  PointCloud cloud = meshes_[static_cast<std::size_t>(shape) % meshes_.size()];
  cloud.points = Deform(shape, cloud.points);
  return cloud;
}

std::vector<Eigen::Vector3d> ShapeFamily::Truth(int shape) const {
  return Deform(shape, source_.points);
}

}  // namespace ceres_ed
