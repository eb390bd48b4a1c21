#include "ceres_ed/registration/rigid_registration.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/registration/rigid_starts.h>
#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include <Eigen/Eigenvalues>

namespace ceres_ed {
namespace {

// Starts are sifted: all of them roughly, the best of them better, the winner to the end.
constexpr int kSiftSamples = 150;
constexpr int kSiftIterations = 8;
constexpr int kSiftKept = 5;
constexpr int kCoarseSamples = 300;
constexpr int kCoarseIterations = 20;
constexpr int kFineSamples = 1500;
constexpr int kFineIterations = 40;
constexpr int kMinPairs = 6;
// Weight of point-to-point beside point-to-plane.
constexpr double kPointShare = 0.1;
// A direction in which the mean squared normal displacement of a unit motion is below this isn't
// determined by point-to-plane distances, unless a step along it explains this share of them.
constexpr double kLeastCurvature = 0.05;
constexpr double kLeastExplained = 0.1;
// Distances below this fraction of the score's width are rounding.
constexpr double kNegligible = 1e-4;

// A pair in the target frame: where the source point is, and the plane that it should be on.
struct PlanePair {
  Eigen::Vector3d moved;
  Eigen::Vector3d target;
  Eigen::Vector3d normal;
  double squared_distance = 0.0;
  bool agrees = false;
  bool on_border = false;
  bool found = false;

  bool IsUsable() const { return found && agrees && !on_border; }
};

using Vector7 = Eigen::Matrix<double, 7, 1>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;

// The normal equations of a step; the right side apart for the two kinds of distance.
struct StepSums {
  Matrix7 H = Matrix7::Zero();
  Vector7 plane_b = Vector7::Zero();
  Vector7 point_b = Vector7::Zero();
  double plane_energy = 0.0;
  double weight = 0.0;
  // Weighted sum of squared levers.
  double spread = 0.0;
};

class RigidAligner {
 public:
  RigidAligner(const Surface& source, const Surface& target, const RigidOptions& options)
      : source_(source),
        target_(target),
        options_(options),
        min_cosine_(std::cos(options.max_angle_deg * M_PI / 180.0)),
        oriented_(source.cloud().normals_oriented && target.cloud().normals_oriented),
        width_(options.score_width * Diagonal(target.cloud().points)) {}

  // Pairs of both directions under a pose; a fixed number, found or not.
  std::vector<PlanePair> Pairs(const Similarity& pose, int samples) const;
  double Score(const Similarity& pose) const;
  Similarity Refine(Similarity pose, int samples, int iterations) const;

 private:
  bool Step(const std::vector<PlanePair>& pairs, double sigma, Similarity* pose) const;
  Vector7 SolveObserved(const StepSums& sums) const;

  const Surface& source_;
  const Surface& target_;
  const RigidOptions& options_;
  double min_cosine_;
  bool oriented_;
  double width_;
};

std::vector<PlanePair> RigidAligner::Pairs(const Similarity& pose, int samples) const {
  const std::vector<int> source_samples = SamplePoints(source_, samples);
  const std::vector<int> target_samples = SamplePoints(target_, samples);
  const Similarity source_from_target = pose.Inverse();
  const int num_forward = static_cast<int>(source_samples.size());
  std::vector<PlanePair> pairs(source_samples.size() + target_samples.size());
  const auto agreement = [&](const Eigen::Vector3d& source_normal, const Eigen::Vector3d& n) {
    const double cosine = (pose.rotation * source_normal).dot(n);
    return (oriented_ ? cosine : std::abs(cosine)) >= min_cosine_;
  };
  const auto match = [&](int i) {
    PlanePair& pair = pairs[i];
    if (i < num_forward) {
      const int point = source_samples[i];
      pair.moved = pose * source_.cloud().points[point];
      const Neighbor hit = target_.tree().Nearest(pair.moved);
      if (!hit.found()) return;
      pair.target = target_.cloud().points[hit.index];
      pair.normal = target_.cloud().normals[hit.index];
      pair.on_border = target_.topology().is_border[hit.index] != 0;
      pair.agrees = agreement(source_.cloud().normals[point], pair.normal);
    } else {
      const int point = target_samples[i - num_forward];
      pair.target = target_.cloud().points[point];
      pair.normal = target_.cloud().normals[point];
      const Neighbor hit = source_.tree().Nearest(source_from_target * pair.target);
      if (!hit.found()) return;
      pair.moved = pose * source_.cloud().points[hit.index];
      pair.on_border = source_.topology().is_border[hit.index] != 0;
      pair.agrees = agreement(source_.cloud().normals[hit.index], pair.normal);
    }
    pair.squared_distance = (pair.moved - pair.target).squaredNorm();
    pair.found = true;
  };
  ParallelFor(options_.num_threads, static_cast<int>(pairs.size()), [&](int begin, int end) {
    for (int i = begin; i < end; ++i) match(i);
  });
  return pairs;
}

double RigidAligner::Score(const Similarity& pose) const {
  const std::vector<PlanePair> pairs = Pairs(pose, kCoarseSamples);
  double sum = 0.0;
  for (const PlanePair& pair : pairs) {
    sum += pair.found && pair.agrees
               ? pair.squared_distance / (pair.squared_distance + width_ * width_)
               : 1.0;
  }
  return pairs.empty() ? 1.0 : sum / static_cast<double>(pairs.size());
}

// One Gauss-Newton step of the reweighted sum of point-to-plane and, with a small share,
// point-to-point distances; false when it can't be taken.
bool RigidAligner::Step(const std::vector<PlanePair>& pairs, double sigma, Similarity* pose) const {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  int count = 0;
  for (const PlanePair& pair : pairs) {
    if (!pair.IsUsable()) continue;
    center += pair.moved;
    ++count;
  }
  if (count < kMinPairs) return false;
  center /= count;
  StepSums sums;
  for (const PlanePair& pair : pairs) {
    if (!pair.IsUsable()) continue;
    const Eigen::Vector3d arm = pair.moved - center;
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
    sums.H += weight * J_plane * J_plane.transpose();
    sums.plane_b -= weight * r_plane * J_plane;
    sums.plane_energy += weight * r_plane * r_plane;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector7 J = derivative(Eigen::Vector3d::Unit(axis));
      sums.H += kPointShare * weight * J * J.transpose();
      sums.point_b -= kPointShare * weight * gap[axis] * J;
    }
    sums.weight += weight;
    sums.spread += weight * arm.squaredNorm();
  }
  if (!(sums.spread > 0.0)) return false;
  const Vector7 delta = SolveObserved(sums);
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
// distances. Turns are measured at the root mean square lever, so that all directions have the unit
// of a length.
Vector7 RigidAligner::SolveObserved(const StepSums& sums) const {
  const double lever = std::sqrt(sums.spread / sums.weight);
  Vector7 unit;
  unit << Eigen::Vector3d::Constant(lever), Eigen::Vector3d::Ones(), lever;
  const Vector7 per_unit = unit.cwiseInverse();
  const int size = options_.with_scale ? 7 : 6;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
      (per_unit.asDiagonal() * sums.H * per_unit.asDiagonal()).topLeftCorner(size, size));
  const Eigen::MatrixXd& directions = eigen.eigenvectors();
  const Eigen::VectorXd plane =
      directions.transpose() * per_unit.cwiseProduct(sums.plane_b).head(size);
  Eigen::VectorXd along =
      plane + directions.transpose() * per_unit.cwiseProduct(sums.point_b).head(size);
  const double unexplained = sums.plane_energy + sums.weight * std::pow(kNegligible * width_, 2);
  for (int i = 0; i < size; ++i) {
    const double curvature = eigen.eigenvalues()[i];
    const bool curved = curvature > (kPointShare + kLeastCurvature) * sums.weight;
    const bool explains = plane[i] * plane[i] > kLeastExplained * curvature * unexplained;
    along[i] = curvature > 0.0 && (curved || explains) ? along[i] / curvature : 0.0;
  }
  Vector7 delta = Vector7::Zero();
  delta.head(size) = directions * along;
  return per_unit.cwiseProduct(delta);
}

Similarity RigidAligner::Refine(Similarity pose, int samples, int iterations) const {
  constexpr double kConverged = 1e-7;
  const double floor = 1e-3 * width_;
  for (int i = 0; i < iterations; ++i) {
    const std::vector<PlanePair> pairs = Pairs(pose, samples);
    std::vector<double> squared;
    for (const PlanePair& pair : pairs) {
      if (pair.IsUsable()) squared.push_back(pair.squared_distance);
    }
    if (squared.empty()) return pose;
    const auto middle = squared.begin() + static_cast<long>(squared.size() / 2);
    std::nth_element(squared.begin(), middle, squared.end());
    const double sigma = std::max(floor, 2.0 * 1.4826 * std::sqrt(*middle));
    const Similarity before = pose;
    if (!Step(pairs, sigma, &pose)) return before;
    const Similarity change = pose * before.Inverse();
    if (change.rotation.angularDistance(Eigen::Quaterniond::Identity()) < kConverged &&
        (pose.translation - before.translation).norm() < kConverged * width_ &&
        std::abs(change.scale - 1.0) < kConverged) {
      break;
    }
  }
  return pose;
}

struct ScoredPose {
  Similarity pose;
  double score = 1.0;
};

}  // namespace

bool RigidOptions::IsValid(std::string* error) const {
  std::ostringstream message;
  if (!(max_angle_deg > 0.0 && max_angle_deg <= 180.0)) {
    message << "max_angle_deg is " << max_angle_deg << ", expected in (0, 180]";
  } else if (!(score_width > 0.0)) {
    message << "score_width is " << score_width << ", expected > 0";
  } else if (!(good_score >= 0.0 && good_score <= 1.0)) {
    message << "good_score is " << good_score << ", expected in [0, 1]";
  } else if (!(preference > 0.0 && preference <= 1.0)) {
    message << "preference is " << preference << ", expected in (0, 1]";
  } else if (num_threads < 1) {
    message << "num_threads is " << num_threads << ", expected >= 1";
  }
  *error = message.str();
  return error->empty();
}

RigidResult AlignRigid(const Surface& source,
                       const Surface& target,
                       const Similarity& initial,
                       const RigidOptions& options) {
  const RigidAligner aligner(source, target, options);
  RigidResult result;
  result.initial_score = aligner.Score(initial);
  const auto stopped = [&] { return options.should_stop && options.should_stop(); };
  const auto refined = [&](const Similarity& start) {
    const Similarity pose = aligner.Refine(start, kCoarseSamples, kCoarseIterations);
    return ScoredPose{pose, aligner.Score(pose)};
  };
  ScoredPose best = refined(initial);
  result.starts_tried = 1;
  // Every other start has to prove itself against the given pose.
  const auto offer = [&](const ScoredPose& candidate) {
    if (candidate.score < options.preference * best.score) best = candidate;
  };
  const std::vector<Similarity> starts =
      RigidStarts(source.cloud().points, target.cloud().points, initial);
  if (best.score > options.good_score && !stopped()) {
    offer(refined(starts.front()));
    ++result.starts_tried;
  }
  if (best.score > options.good_score) {
    std::vector<ScoredPose> sifted;
    for (std::size_t i = 1; i < starts.size() && !stopped(); ++i) {
      const Similarity pose = aligner.Refine(starts[i], kSiftSamples, kSiftIterations);
      sifted.push_back({pose, aligner.Score(pose)});
      ++result.starts_tried;
    }
    std::stable_sort(sifted.begin(), sifted.end(), [](const ScoredPose& a, const ScoredPose& b) {
      return a.score < b.score;
    });
    if (sifted.size() > kSiftKept) sifted.resize(kSiftKept);
    ScoredPose best_sifted{initial, std::numeric_limits<double>::infinity()};
    for (const ScoredPose& pose : sifted) {
      const ScoredPose candidate = stopped() ? pose : refined(pose.pose);
      if (candidate.score < best_sifted.score) best_sifted = candidate;
    }
    offer(best_sifted);
  }
  result.target_from_source = aligner.Refine(best.pose, kFineSamples, kFineIterations);
  result.score = aligner.Score(result.target_from_source);
  return result;
}

}  // namespace ceres_ed
