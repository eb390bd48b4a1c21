#include "ceres_ed/registration/rigid/rigid_aligner.h"

#include <ceres_ed/util/parallel.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

constexpr int kMinPairs = 6;
// The weight of point-to-point distances relative to point-to-plane distances.
constexpr double kPointShare = 0.1;
// A direction is not determined by the point-to-plane distances if a unit motion along it has a
// mean squared normal displacement below kLeastCurvature, unless a step along it explains the share
// kLeastExplained of the distances.
constexpr double kLeastCurvature = 0.05;
constexpr double kLeastExplained = 0.1;
// A mean squared normal displacement below this is a rounding error.
constexpr double kNoCurvature = 1e-5;
// Distances below this fraction of the score's width are rounding errors.
constexpr double kNegligible = 1e-4;
// The width of the loss is twice the robust standard deviation of the distances, and at least this
// fraction of the score's width.
constexpr double kWidthPerMedian = 2.0 * kDeviationPerMedian;
constexpr double kLeastWidth = 1e-3;

// The angle between normals at which a point counts half as unmatched.
constexpr double kAngleWidth = 30.0 * M_PI / 180.0;
// The weight, in the total, of the surface that is explained worse.
constexpr double kWorseShare = 0.2;

}  // namespace

// A pair in the target frame: the position of the source point, and the plane on which it should
// lie.
struct RigidAligner::PlanePair {
  Eigen::Vector3d moved;
  Eigen::Vector3d target;
  Eigen::Vector3d normal;
  double squared_distance = 0.0;
  // The cosine of the angle between the normals.
  double cosine = -1.0;
  bool agrees = false;
  // Whether the partner lies on the border of its surface, and whether the sample does, too.
  bool on_border = false;
  bool joins_borders = false;
  bool found = false;

  bool IsUsable() const { return found && agrees && !on_border; }
  // Returns whether a border lies beyond a border.
  bool IsBorderPair() const { return found && agrees && joins_borders; }
};

// The normal equations of a step. The right sides of the two kinds of distance are kept separately.
struct RigidAligner::StepSums {
  Eigen::Matrix<double, 7, 7> H = Eigen::Matrix<double, 7, 7>::Zero();
  // The part of H that comes from point-to-plane distances.
  Eigen::Matrix<double, 7, 7> plane_information = Eigen::Matrix<double, 7, 7>::Zero();
  Vector7 plane_b = Vector7::Zero();
  Vector7 point_b = Vector7::Zero();
  double plane_energy = 0.0;
  double weight = 0.0;
  // The weighted sum of the squared levers.
  double spread = 0.0;
};

RigidSide MakeRigidSide(const Surface& surface, int samples) {
  return {&surface.cloud().points,
          &surface.cloud().normals,
          &surface.topology().is_border,
          &surface.tree(),
          SamplePoints(surface, samples)};
}

RigidSide MakeRigidSide(const CoarseSurface& surface, int samples) {
  RigidSide side{&surface.points(), &surface.normals(), &surface.is_border(), &surface.tree(), {}};
  const int count = std::min(samples, surface.size());
  for (int i = 0; i < count; ++i) {
    side.samples.push_back(static_cast<int>(static_cast<long>(i) * surface.size() / count));
  }
  return side;
}

double RigidScore::Total() const {
  return (1.0 - kWorseShare) * std::min(source_unmatched, target_unmatched) +
         kWorseShare * std::max(source_unmatched, target_unmatched);
}

RigidAligner::RigidAligner(RigidSide source, RigidSide target, const RigidAlignerOptions& options)
    : source_(std::move(source)),
      target_(std::move(target)),
      options_(options),
      min_cosine_(std::cos(options.max_angle_deg * M_PI / 180.0)) {}

std::vector<RigidAligner::PlanePair> RigidAligner::Pairs(const Similarity& pose,
                                                         std::vector<int>* nearest) const {
  constexpr double kAnywhere = std::numeric_limits<double>::infinity();
  const Similarity source_from_target = pose.Inverse();
  const int num_forward = static_cast<int>(source_.samples.size());
  std::vector<PlanePair> pairs(source_.samples.size() + target_.samples.size());
  nearest->resize(pairs.size(), -1);
  const auto agreement = [&](const Eigen::Vector3d& source_normal, const Eigen::Vector3d& n) {
    const double cosine = (pose.rotation * source_normal).dot(n);
    if (!options_.oriented) return std::abs(cosine);
    return options_.reversed ? -cosine : cosine;
  };
  const auto match = [&](int i) {
    PlanePair& pair = pairs[i];
    if (i < num_forward) {
      const int point = source_.samples[i];
      pair.moved = pose * (*source_.points)[point];
      const Neighbor hit = target_.tree->NearestWithin(pair.moved, kAnywhere, (*nearest)[i]);
      if (!hit.found()) return;
      (*nearest)[i] = hit.index;
      pair.target = (*target_.points)[hit.index];
      pair.normal = (*target_.normals)[hit.index];
      pair.on_border = (*target_.is_border)[hit.index] != 0;
      pair.joins_borders = pair.on_border && (*source_.is_border)[point] != 0;
      pair.cosine = agreement((*source_.normals)[point], pair.normal);
    } else {
      const int point = target_.samples[i - num_forward];
      pair.target = (*target_.points)[point];
      pair.normal = (*target_.normals)[point];
      const Neighbor hit =
          source_.tree->NearestWithin(source_from_target * pair.target, kAnywhere, (*nearest)[i]);
      if (!hit.found()) return;
      (*nearest)[i] = hit.index;
      pair.moved = pose * (*source_.points)[hit.index];
      pair.on_border = (*source_.is_border)[hit.index] != 0;
      pair.joins_borders = pair.on_border && (*target_.is_border)[point] != 0;
      pair.cosine = agreement((*source_.normals)[hit.index], pair.normal);
    }
    pair.squared_distance = (pair.moved - pair.target).squaredNorm();
    pair.agrees = pair.cosine >= min_cosine_;
    pair.found = true;
  };
  ParallelFor(options_.num_threads, static_cast<int>(pairs.size()), [&](int begin, int end) {
    for (int i = begin; i < end; ++i) match(i);
  });
  return pairs;
}

RigidScore RigidAligner::Score(const Similarity& pose) const {
  std::vector<int> nearest;
  const std::vector<PlanePair> pairs = Pairs(pose, &nearest);
  const std::size_t num_forward = source_.samples.size();
  const double scale = 1.0 / (options_.width * options_.width);
  double unmatched[2] = {0.0, 0.0};
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const PlanePair& pair = pairs[i];
    double share = 1.0;
    if (pair.found && pair.agrees) {
      const double angle = std::acos(std::clamp(pair.cosine, -1.0, 1.0)) / kAngleWidth;
      const Eigen::Vector3d gap = pair.moved - pair.target;
      // The distance across the surface, and the one along it beyond the spacing of the samples.
      const double off = pair.normal.dot(gap);
      const double along = std::max(
          0.0, std::sqrt(std::max(0.0, pair.squared_distance - off * off)) - options_.slack);
      const double q = (off * off + along * along) * scale + angle * angle;
      share = q / (1.0 + q);
    }
    unmatched[i < num_forward ? 0 : 1] += share;
  }
  RigidScore score;
  if (num_forward > 0) score.source_unmatched = unmatched[0] / static_cast<double>(num_forward);
  if (pairs.size() > num_forward) {
    score.target_unmatched = unmatched[1] / static_cast<double>(pairs.size() - num_forward);
  }
  return score;
}

bool RigidAligner::Collect(const std::vector<PlanePair>& pairs,
                           double sigma,
                           double point_share,
                           Eigen::Vector3d* center,
                           StepSums* sums) const {
  *center = Eigen::Vector3d::Zero();
  int count = 0;
  for (const PlanePair& pair : pairs) {
    if (!pair.IsUsable()) continue;
    *center += pair.moved;
    ++count;
  }
  if (count < kMinPairs) return false;
  *center /= count;
  for (const PlanePair& pair : pairs) {
    if (!pair.IsUsable()) continue;
    const Eigen::Vector3d arm = pair.moved - *center;
    const Eigen::Vector3d gap = pair.moved - pair.target;
    const double ratio = sigma * sigma / (sigma * sigma + pair.squared_distance);
    const double weight = ratio * ratio;
    const auto derivative = [&arm](const Eigen::Vector3d& direction) {
      Vector7 J;
      J << arm.cross(direction), direction, direction.dot(arm);
      return J;
    };
    const Vector7 J_plane = derivative(pair.normal);
    const double r_plane = pair.normal.dot(gap);
    sums->plane_information += weight * J_plane * J_plane.transpose();
    sums->plane_b -= weight * r_plane * J_plane;
    sums->plane_energy += weight * r_plane * r_plane;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector7 J = derivative(Eigen::Vector3d::Unit(axis));
      sums->H += point_share * weight * J * J.transpose();
      sums->point_b -= point_share * weight * gap[axis] * J;
    }
    sums->weight += weight;
    sums->spread += weight * arm.squaredNorm();
  }
  sums->H += sums->plane_information;
  return sums->spread > 0.0;
}

// Adds the point-to-point distances of the pairs that join borders, about the same center. The
// width of their loss follows from their own spread, because borders may lie far apart where the
// surfaces already lie on each other.
void RigidAligner::AddBorders(const std::vector<PlanePair>& pairs,
                              const Eigen::Vector3d& center,
                              StepSums* sums) const {
  std::vector<double> squared;
  for (const PlanePair& pair : pairs) {
    if (pair.IsBorderPair()) squared.push_back(pair.squared_distance);
  }
  if (squared.empty()) return;
  const double distance = std::sqrt(Median(std::move(squared)));
  const double sigma = std::max(options_.width, kWidthPerMedian * distance);
  for (const PlanePair& pair : pairs) {
    if (!pair.IsBorderPair()) continue;
    const double ratio = sigma * sigma / (sigma * sigma + pair.squared_distance);
    const Eigen::Vector3d arm = pair.moved - center;
    const Eigen::Vector3d gap = pair.moved - pair.target;
    for (int axis = 0; axis < 3; ++axis) {
      Vector7 J;
      J << arm.cross(Eigen::Vector3d::Unit(axis)), Eigen::Vector3d::Unit(axis), arm[axis];
      sums->H += ratio * ratio * J * J.transpose();
      sums->plane_b -= ratio * ratio * gap[axis] * J;
    }
  }
}

// Does one Gauss-Newton step for the reweighted sum of point-to-plane and, with a small share,
// point-to-point distances. Returns false if the step cannot be computed.
bool RigidAligner::Step(const std::vector<PlanePair>& pairs,
                        double sigma,
                        StepDirections directions,
                        Similarity* pose) const {
  const double point_share = directions == StepDirections::kDetermined ? kPointShare : 0.0;
  Eigen::Vector3d center;
  StepSums sums;
  if (!Collect(pairs, sigma, point_share, &center, &sums)) return false;
  if (directions == StepDirections::kAllWithBorders) AddBorders(pairs, center, &sums);
  const Vector7 delta = SolveObserved(sums, directions);
  if (!delta.allFinite()) return false;
  const double angle = delta.head<3>().norm();
  Similarity step;
  if (angle > 0.0) {
    step.rotation = Eigen::AngleAxisd(angle, Eigen::Vector3d(delta.head<3>() / angle));
  }
  if (options_.with_scale) step.scale = std::exp(std::clamp(delta[6], -0.2, 0.2));
  step.translation = center + delta.segment<3>(3) - step.scale * (step.rotation * center);
  *pose = step * *pose;
  return true;
}

// The step in the directions that the pairs really determine. A sheet slides in its plane and a
// round body turns about its axis at next to no cost: where the surfaces differ by more than a
// rigid motion they would do so, so a direction of little curvature is left as it is (Zhang et al.
// 2016, "On degeneracy") unless moving along it explains a good part of the point-to-plane
// distances. (Without that rule, only directions of no curvature at all are left out.) Turns are
// measured at the root mean square lever, so that all directions have the unit
// of a length.
RigidAligner::Vector7 RigidAligner::SolveObserved(const StepSums& sums,
                                                  StepDirections directions) const {
  const double lever = std::sqrt(sums.spread / sums.weight);
  Vector7 unit;
  unit << Eigen::Vector3d::Constant(lever), Eigen::Vector3d::Ones(), lever;
  const Vector7 per_unit = unit.cwiseInverse();
  const int size = options_.with_scale ? 7 : 6;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
      (per_unit.asDiagonal() * sums.H * per_unit.asDiagonal()).topLeftCorner(size, size));
  const Eigen::MatrixXd& axes = eigen.eigenvectors();
  const Eigen::VectorXd plane = axes.transpose() * per_unit.cwiseProduct(sums.plane_b).head(size);
  Eigen::VectorXd along = plane + axes.transpose() * per_unit.cwiseProduct(sums.point_b).head(size);
  const double unexplained =
      sums.plane_energy + sums.weight * std::pow(kNegligible * options_.width, 2);
  const double least =
      directions == StepDirections::kDetermined ? kPointShare + kLeastCurvature : kNoCurvature;
  for (int i = 0; i < size; ++i) {
    const double curvature = eigen.eigenvalues()[i];
    const bool curved = curvature > least * sums.weight;
    const bool explains = directions == StepDirections::kDetermined &&
                          plane[i] * plane[i] > kLeastExplained * curvature * unexplained;
    along[i] = curvature > 0.0 && (curved || explains) ? along[i] / curvature : 0.0;
  }
  Vector7 delta = Vector7::Zero();
  delta.head(size) = axes * along;
  return per_unit.cwiseProduct(delta);
}

double RigidAligner::LeastCurvature(const Similarity& pose) const {
  std::vector<int> nearest;
  Eigen::Vector3d center;
  StepSums sums;
  if (!Collect(Pairs(pose, &nearest), options_.width, 0.0, &center, &sums)) return 0.0;
  const double lever = std::sqrt(sums.spread / sums.weight);
  Eigen::Matrix<double, 6, 1> per_unit;
  per_unit << Eigen::Vector3d::Constant(1.0 / lever), Eigen::Vector3d::Ones();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(
      per_unit.asDiagonal() * sums.plane_information.topLeftCorner<6, 6>() * per_unit.asDiagonal());
  return std::clamp(eigen.eigenvalues()[0] / sums.weight, 0.0, 1.0);
}

Similarity RigidAligner::Refine(Similarity pose, int iterations, StepDirections directions) const {
  constexpr double kConverged = 1e-7;
  const double floor = kLeastWidth * options_.width;
  std::vector<int> nearest;
  for (int i = 0; i < iterations; ++i) {
    const std::vector<PlanePair> pairs = Pairs(pose, &nearest);
    std::vector<double> squared;
    for (const PlanePair& pair : pairs) {
      if (pair.IsUsable()) squared.push_back(pair.squared_distance);
    }
    if (squared.empty()) return pose;
    const double distance = std::sqrt(Median(std::move(squared)));
    const double sigma = std::max(floor, kWidthPerMedian * distance);
    Similarity before = pose;
    if (!Step(pairs, sigma, directions, &pose)) return before;
    const Similarity change = pose * before.Inverse();
    if (change.rotation.angularDistance(Eigen::Quaterniond::Identity()) < kConverged &&
        (pose.translation - before.translation).norm() < kConverged * options_.width &&
        std::abs(change.scale - 1.0) < kConverged) {
      break;
    }
  }
  return pose;
}

}  // namespace ceres_ed
