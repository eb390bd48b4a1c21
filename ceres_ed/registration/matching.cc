#include "ceres_ed/registration/matching.h"

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace ceres_ed {
namespace {

// 1.4826 median |x| estimates sigma of a Gaussian.
constexpr double kMadToSigma = 1.4826;

// A pair before it is believed.
struct Candidate {
  Correspondence match;
  double distance = std::numeric_limits<double>::infinity();
  bool on_border = false;
  bool normals_agree = false;

  bool IsPlausible() const { return normals_agree && !on_border; }
};

// Whether two normals are near enough, up to sign where either surface knows them only so far.
class NormalTest {
 public:
  NormalTest(const Surface& a, const Surface& b, const MatchingOptions& options)
      : min_cosine_(std::cos(options.max_angle_deg * M_PI / 180.0)),
        oriented_(a.cloud().normals_oriented && b.cloud().normals_oriented) {}

  bool Agree(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    const double cosine = a.dot(b);
    return (oriented_ ? cosine : std::abs(cosine)) >= min_cosine_;
  }

 private:
  double min_cosine_;
  bool oriented_;
};

// The mean of two normals, for the symmetric point-to-plane distance (Rusinkiewicz 2019): exact
// along a second order curve through both points, so that surfaces may slide along each other.
Eigen::Vector3d SymmetricNormal(const Eigen::Vector3d& source, const Eigen::Vector3d& target) {
  const Eigen::Vector3d sum = target + (source.dot(target) < 0.0 ? -source : source);
  const double norm = sum.norm();
  return norm > 0.0 ? Eigen::Vector3d(sum / norm) : target;
}

// The part of `gap` along the surface, of at most `radius`: a target point between two source
// points is no farther from the surface than if it faced one of them.
Eigen::Vector3d OffsetWithinDisc(const Eigen::Vector3d& gap,
                                 const Eigen::Vector3d& normal,
                                 double radius) {
  const Eigen::Vector3d along = gap - normal * normal.dot(gap);
  const double length = along.norm();
  return length > radius ? Eigen::Vector3d(along * (radius / length)) : along;
}

void MatchForward(const MovedSource& source,
                  const std::vector<int>& samples,
                  const Surface& target,
                  const MatchingOptions& options,
                  Candidate* candidates) {
  const NormalTest normals(*source.rest, target, options);
  ParallelFor(options.num_threads, static_cast<int>(samples.size()), [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const int point = samples[i];
      const SurfaceHit hit = target.index().Closest((*source.points)[point], options.max_distance);
      if (!hit.found()) continue;
      Candidate& candidate = candidates[i];
      const Eigen::Vector3d& normal = (*source.normals)[point];
      const Eigen::Vector3d target_normal = target.NormalAt(hit);
      candidate.match = {point,
                         hit.position,
                         SymmetricNormal(normal, target_normal),
                         source.rest->relative_areas()[point] / samples.size()};
      candidate.distance = std::sqrt(hit.squared_distance);
      candidate.on_border = hit.on_border;
      candidate.normals_agree = normals.Agree(normal, target_normal);
    }
  });
}

void MatchBackward(const MovedSource& source,
                   const Surface& target,
                   const std::vector<int>& samples,
                   const MatchingOptions& options,
                   Candidate* candidates) {
  if (samples.empty()) return;
  const NormalTest normals(*source.rest, target, options);
  const KdTree tree(*source.points);
  ParallelFor(options.num_threads, static_cast<int>(samples.size()), [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const Eigen::Vector3d& position = target.cloud().points[samples[i]];
      const Eigen::Vector3d& target_normal = target.cloud().normals[samples[i]];
      const Neighbor nearest = tree.NearestWithin(position, options.max_distance);
      if (!nearest.found()) continue;
      const Eigen::Vector3d& normal = (*source.normals)[nearest.index];
      const Eigen::Vector3d gap = position - (*source.points)[nearest.index];
      const Eigen::Vector3d aside =
          OffsetWithinDisc(gap, normal, source.rest->radius(nearest.index));
      Candidate& candidate = candidates[i];
      candidate.match = {nearest.index,
                         position - aside,
                         SymmetricNormal(normal, target_normal),
                         target.relative_areas()[samples[i]] / samples.size()};
      candidate.distance = (gap - aside).norm();
      candidate.on_border = source.rest->topology().is_border[nearest.index] != 0;
      candidate.normals_agree = normals.Agree(normal, target_normal);
    }
  });
}

double MedianDistance(const std::vector<Candidate>& candidates) {
  std::vector<double> distances;
  distances.reserve(candidates.size());
  for (const Candidate& candidate : candidates) {
    if (candidate.IsPlausible()) distances.push_back(candidate.distance);
  }
  if (distances.empty()) return 0.0;
  const auto middle = distances.begin() + static_cast<long>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

// The candidates of the source's samples, then those of the target's.
std::vector<Candidate> FindCandidates(const MovedSource& source,
                                      const std::vector<int>& source_samples,
                                      const Surface& target,
                                      const std::vector<int>& target_samples,
                                      const MatchingOptions& options) {
  std::vector<Candidate> candidates(source_samples.size() + target_samples.size());
  MatchForward(source, source_samples, target, options, candidates.data());
  MatchBackward(source, target, target_samples, options, candidates.data() + source_samples.size());
  return candidates;
}

}  // namespace

bool MatchingOptions::IsValid(std::string* error) const {
  std::ostringstream message;
  if (!(max_distance > 0.0)) {
    message << "max_distance is " << max_distance << ", expected > 0";
  } else if (!(max_angle_deg > 0.0 && max_angle_deg <= 180.0)) {
    message << "max_angle_deg is " << max_angle_deg << ", expected in (0, 180]";
  } else if (!(max_deviations > 0.0)) {
    message << "max_deviations is " << max_deviations << ", expected > 0";
  } else if (!(resolution >= 0.0)) {
    message << "resolution is " << resolution << ", expected >= 0";
  } else if (num_threads < 1) {
    message << "num_threads is " << num_threads << ", expected >= 1";
  }
  *error = message.str();
  return error->empty();
}

Matches MatchBothWays(const MovedSource& source,
                      const std::vector<int>& source_samples,
                      const Surface& target,
                      const std::vector<int>& target_samples,
                      const MatchingOptions& options) {
  const std::vector<Candidate> candidates =
      FindCandidates(source, source_samples, target, target_samples, options);
  Matches matches;
  matches.robust_distance = kMadToSigma * MedianDistance(candidates);
  const double limit =
      std::max(options.resolution, options.max_deviations * matches.robust_distance);
  double sum_plane = 0.0;
  double sum_point = 0.0;
  for (const Candidate& candidate : candidates) {
    if (candidate.match.point < 0) continue;
    ++matches.candidates;
    if (!candidate.IsPlausible() || candidate.distance > limit) continue;
    matches.correspondences.push_back(candidate.match);
    const Eigen::Vector3d gap = (*source.points)[candidate.match.point] - candidate.match.target;
    sum_plane += std::pow(gap.dot(candidate.match.normal), 2);
    sum_point += gap.squaredNorm();
  }
  matches.inliers = static_cast<int>(matches.correspondences.size());
  if (matches.inliers > 0) {
    matches.rms_plane = std::sqrt(sum_plane / matches.inliers);
    matches.rms_point = std::sqrt(sum_point / matches.inliers);
  }
  return matches;
}

double UnmatchedShare(const MovedSource& source,
                      const std::vector<int>& source_samples,
                      const Surface& target,
                      const std::vector<int>& target_samples,
                      double width,
                      const MatchingOptions& options) {
  const std::vector<Candidate> candidates =
      FindCandidates(source, source_samples, target, target_samples, options);
  double sum = 0.0;
  for (const Candidate& candidate : candidates) {
    const double squared = candidate.distance * candidate.distance;
    sum += candidate.match.point >= 0 && candidate.normals_agree
               ? squared / (squared + width * width)
               : 1.0;
  }
  return candidates.empty() ? 1.0 : sum / static_cast<double>(candidates.size());
}

}  // namespace ceres_ed
