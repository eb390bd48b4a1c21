#include "ceres_ed/registration/matching.h"

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/util/parallel.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// A pair before it is accepted or rejected.
struct Candidate {
  Correspondence match;
  // The vector from the target to the source.
  Eigen::Vector3d gap = Eigen::Vector3d::Zero();
  double distance = std::numeric_limits<double>::infinity();
  bool on_border = false;
  bool normals_agree = false;

  bool IsPlausible() const { return normals_agree && !on_border; }
};

// Tests whether two normals are similar; up to sign if one of the surfaces knows them only up to
// sign.
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

// Returns the mean of two normals for the symmetric point-to-plane distance (Rusinkiewicz 2019).
// The distance is exact along a second-order curve through both points, so that surfaces can slide
// along each other.
Eigen::Vector3d PairNormal(const Eigen::Vector3d& source,
                           const Eigen::Vector3d& target,
                           const MatchingOptions& options) {
  if (!options.symmetric_normals) return target;
  const Eigen::Vector3d sum = target + (source.dot(target) < 0.0 ? -source : source);
  const double norm = sum.norm();
  return norm > 0.0 ? Eigen::Vector3d(sum / norm) : target;
}

// Returns the distance of a target point at `gap` from the disc of `radius` around a source point.
double DistanceFromDisc(const Eigen::Vector3d& gap, const Eigen::Vector3d& normal, double radius) {
  const double across = normal.dot(gap);
  const double along = std::sqrt(std::max(0.0, gap.squaredNorm() - across * across));
  return std::hypot(across, std::max(0.0, along - radius));
}

// Returns the data of a pair. `normal` is the normal of the source's `point` under the present
// warp.
MatchDetail Detail(const MovedSource& source,
                   int point,
                   const Eigen::Vector3d& normal,
                   const Eigen::Vector3d& target_normal,
                   const Intensity& target_intensity) {
  const PointCloud& rest = source.rest->cloud();
  MatchDetail detail;
  detail.source_normal = normal;
  detail.target_normal = target_normal;
  if (rest.HasIntensities()) detail.source_intensity = rest.intensities[point];
  detail.target_intensity = target_intensity.value;
  detail.intensity_gradient = target_intensity.gradient;
  return detail;
}

// `details` may be null; otherwise it has one entry per candidate.
void MatchForward(const MovedSource& source,
                  const Surface& target,
                  const MatchingOptions& options,
                  MatchMemory* memory,
                  Candidate* candidates,
                  MatchDetail* details) {
  const std::vector<int>& samples = *source.samples;
  memory->on_target.resize(samples.size(), -1);
  const NormalTest normals(*source.rest, target, options);
  const SurfaceIndex& index = target.index();
  const std::vector<int>& order = memory->source_tree->order();
  ParallelFor(options.num_threads, static_cast<int>(samples.size()), [&](int begin, int end) {
    for (int place = begin; place < end; ++place) {
      const int i = order[place];
      const Eigen::Vector3d& point = (*source.points)[i];
      const SurfaceHit hit = index.Closest(point, options.max_distance, memory->on_target[i]);
      if (!hit.found()) continue;
      memory->on_target[i] = hit.place();
      Candidate& candidate = candidates[i];
      const Eigen::Vector3d& normal = (*source.normals)[i];
      const Eigen::Vector3d target_normal = target.NormalAt(hit);
      candidate.match = {samples[i],
                         /*detail=*/-1,
                         hit.position,
                         PairNormal(normal, target_normal, options),
                         source.rest->relative_areas()[samples[i]] / samples.size()};
      candidate.gap = point - hit.position;
      candidate.distance = std::sqrt(hit.squared_distance);
      candidate.on_border = options.reject_borders && hit.on_border;
      candidate.normals_agree = normals.Agree(normal, target_normal);
      if (details != nullptr) {
        details[i] = Detail(source, samples[i], normal, target_normal, target.IntensityAt(hit));
      }
    }
  });
}

void MatchBackward(const MovedSource& source,
                   const Surface& target,
                   const std::vector<int>& target_samples,
                   const MatchingOptions& options,
                   MatchMemory* memory,
                   Candidate* candidates,
                   MatchDetail* details) {
  const std::vector<int>& samples = *source.samples;
  memory->in_source.resize(target_samples.size(), -1);
  if (samples.empty() || target_samples.empty()) return;
  const NormalTest normals(*source.rest, target, options);
  const KdTree& tree = *memory->source_tree;
  // Each sample also represents the points between the samples, so its disc is larger.
  const double spread = std::sqrt(static_cast<double>(source.rest->cloud().size()) /
                                  static_cast<double>(samples.size()));
  const int count = static_cast<int>(target_samples.size());
  ParallelFor(options.num_threads, count, [&](int begin, int end) {
    for (int place = begin; place < end; ++place) {
      const int i = memory->target_order[place];
      const int point = target_samples[i];
      const Eigen::Vector3d& position = target.cloud().points[point];
      const Eigen::Vector3d& target_normal = target.cloud().normals[point];
      const Neighbor nearest =
          tree.NearestWithin(position, options.max_distance, memory->in_source[i]);
      if (!nearest.found()) continue;
      memory->in_source[i] = nearest.index;
      const int sample = samples[nearest.index];
      const Eigen::Vector3d& normal = (*source.normals)[nearest.index];
      Candidate& candidate = candidates[i];
      candidate.match = {sample,
                         /*detail=*/-1,
                         position,
                         PairNormal(normal, target_normal, options),
                         target.relative_areas()[point] / count};
      candidate.gap = (*source.points)[nearest.index] - position;
      candidate.distance = DistanceFromDisc(
          candidate.gap, candidate.match.normal, spread * source.rest->radius(sample));
      candidate.on_border =
          options.reject_borders && source.rest->topology().is_border[sample] != 0;
      candidate.normals_agree = normals.Agree(normal, target_normal);
      if (details != nullptr) {
        details[i] = Detail(source, sample, normal, target_normal, target.IntensityOf(point));
      }
    }
  });
}

// Updates the trees and orders in `memory`.
void Prepare(const MovedSource& source,
             const Surface& target,
             const std::vector<int>& target_samples,
             MatchMemory* memory) {
  if (memory->source_tree != nullptr && memory->source_points == source.points) {
    memory->source_tree->Update();
    return;
  }
  memory->source_tree = std::make_unique<KdTree>(*source.points);
  memory->source_points = source.points;
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(target_samples.size());
  for (const int point : target_samples) positions.push_back(target.cloud().points[point]);
  memory->target_order = KdTree(positions).order();
}

double MedianDistance(const std::vector<Candidate>& candidates) {
  std::vector<double> distances;
  distances.reserve(candidates.size());
  for (const Candidate& candidate : candidates) {
    if (candidate.IsPlausible()) distances.push_back(candidate.distance);
  }
  return Median(std::move(distances));
}

// Returns the candidates of the source samples, followed by those of the target samples. `details`
// has one entry per candidate and may be null.
std::vector<Candidate> FindCandidates(const MovedSource& source,
                                      const Surface& target,
                                      const std::vector<int>& target_samples,
                                      const MatchingOptions& options,
                                      MatchMemory* memory,
                                      std::vector<MatchDetail>* details) {
  CHECK_EQ(source.points->size(), source.samples->size());
  CHECK_EQ(source.normals->size(), source.samples->size());
  std::vector<Candidate> candidates(source.samples->size() + target_samples.size());
  MatchMemory none;
  if (memory == nullptr) memory = &none;
  const std::size_t num_forward = source.samples->size();
  if (details != nullptr) details->resize(candidates.size());
  const auto details_from = [details](std::size_t first) {
    return details != nullptr ? details->data() + first : nullptr;
  };
  Prepare(source, target, target_samples, memory);
  MatchForward(source, target, options, memory, candidates.data(), details_from(0));
  MatchBackward(source,
                target,
                target_samples,
                options,
                memory,
                candidates.data() + num_forward,
                details_from(num_forward));
  return candidates;
}

}  // namespace

Matches MatchBothWays(const MovedSource& source,
                      const Surface& target,
                      const std::vector<int>& target_samples,
                      const MatchingOptions& options,
                      MatchMemory* memory) {
  std::vector<MatchDetail> details;
  const std::vector<Candidate> candidates = FindCandidates(
      source, target, target_samples, options, memory, options.with_details ? &details : nullptr);
  Matches matches;
  matches.robust_distance = kDeviationPerMedian * MedianDistance(candidates);
  // The limit on the distance of a pair follows from the robust deviation of all pairs.
  const double limit =
      std::max(options.resolution, options.max_deviations * matches.robust_distance);
  const auto is_accepted = [limit](const Candidate& candidate) {
    return candidate.match.point >= 0 && candidate.IsPlausible() && candidate.distance <= limit;
  };
  const auto num_accepted = std::count_if(candidates.begin(), candidates.end(), is_accepted);
  matches.correspondences.reserve(num_accepted);
  if (options.with_details) matches.details.reserve(num_accepted);
  double sum_plane = 0.0;
  double sum_point = 0.0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& candidate = candidates[i];
    if (candidate.match.point >= 0) ++matches.candidates;
    if (!is_accepted(candidate)) continue;
    matches.correspondences.push_back(candidate.match);
    if (options.with_details) {
      matches.correspondences.back().detail = static_cast<int>(matches.details.size());
      matches.details.push_back(details[i]);
    }
    sum_plane += std::pow(candidate.gap.dot(candidate.match.normal), 2);
    sum_point += candidate.gap.squaredNorm();
  }
  matches.inliers = static_cast<int>(matches.correspondences.size());
  if (matches.inliers > 0) {
    matches.rms_plane = std::sqrt(sum_plane / matches.inliers);
    matches.rms_point = std::sqrt(sum_point / matches.inliers);
  }
  return matches;
}

Unmatched FindUnmatched(const MovedSource& source,
                        const Surface& target,
                        const std::vector<int>& target_samples,
                        double width,
                        const MatchingOptions& options) {
  const std::vector<Candidate> candidates =
      FindCandidates(source, target, target_samples, options, nullptr, nullptr);
  const auto share = [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      const double squared = candidates[i].distance * candidates[i].distance;
      sum += candidates[i].match.point >= 0 && candidates[i].normals_agree
                 ? squared / (squared + width * width)
                 : 1.0;
    }
    return begin == end ? 1.0 : sum / static_cast<double>(end - begin);
  };
  const std::size_t middle = source.samples->size();
  return {share(0, middle), share(middle, candidates.size())};
}

}  // namespace ceres_ed
