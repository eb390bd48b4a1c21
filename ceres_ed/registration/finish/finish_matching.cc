#include "ceres_ed/registration/finish/finish_matching.h"

#include <ceres_ed/geometry/closest_point.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ceres_ed {
namespace {

// Target samples per vertex; more of them would add no information.
constexpr int kSamplesPerVertex = 2;
// The number of matches between two questions whether to stop.
constexpr std::size_t kMatchesPerPoll = 4096;

bool MustStopAt(std::size_t match, const std::function<bool()>& should_stop) {
  return match % kMatchesPerPoll == 0 && should_stop && should_stop();
}

// Returns the offset, at the point `blend` of a triangle, from the triangle to the curved surface
// that it approximates. It is computed from the normals of the corners to second order (half of the
// offset of Phong tessellation; Boubekeur and Alexa 2008), and does not depend on the sign of each
// normal.
Eigen::Vector3d Sagitta(const std::array<int, 3>& triangle,
                        const Eigen::Vector3d& blend,
                        const std::vector<Eigen::Vector3d>& points,
                        const std::vector<Eigen::Vector3d>& normals) {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) position += blend[k] * points[triangle[k]];
  Eigen::Vector3d sagitta = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d& normal = normals[triangle[k]];
    sagitta -= 0.5 * blend[k] * normal.dot(position - points[triangle[k]]) * normal;
  }
  return sagitta;
}

}  // namespace

FinishMatcher::FinishMatcher(const Surface& source,
                             const WeldedMesh& mesh,
                             const std::vector<Eigen::Vector3d>& fallback_normals,
                             const Surface& target,
                             const MatchingOptions& options)
    : source_(source),
      mesh_(mesh),
      fallback_normals_(fallback_normals),
      target_(target),
      options_(options),
      target_samples_(SamplePoints(target, kSamplesPerVertex * mesh.num_vertices())),
      on_target_(mesh.num_vertices(), -1),
      nearest_vertex_(target_samples_.size(), -1),
      min_cosine_(std::cos(options.max_angle_deg * M_PI / 180.0)),
      oriented_(source.cloud().normals_oriented && target.cloud().normals_oriented) {}

Eigen::Vector3d FinishMatcher::Between(const Eigen::Vector3d& moving,
                                       const Eigen::Vector3d& still) const {
  const double cosine = moving.dot(still);
  const double sign = !oriented_ && cosine < 0.0 ? -1.0 : 1.0;
  if (!(sign * cosine >= min_cosine_)) return Eigen::Vector3d::Zero();
  return (sign * moving + still).normalized();
}

bool FinishMatcher::MatchForward(const std::vector<Eigen::Vector3d>& points,
                                 const std::vector<Eigen::Vector3d>& normals,
                                 const std::function<bool()>& should_stop,
                                 std::vector<Candidate>* candidates) {
  const SurfaceIndex& index = target_.index();
  for (int v = 0; v < mesh_.num_vertices(); ++v) {
    if (MustStopAt(v, should_stop)) return false;
    if (!mesh_.triangles.empty() && mesh_.around_offsets[v] == mesh_.around_offsets[v + 1]) {
      continue;
    }
    const SurfaceHit hit = index.Closest(points[v], options_.max_distance, on_target_[v]);
    on_target_[v] = hit.place();
    if (!hit.found() || hit.on_border) continue;
    Candidate candidate;
    candidate.pair.normal = Between(normals[v], target_.NormalAt(hit));
    if (candidate.pair.normal.isZero(0.0)) continue;
    candidate.pair.vertices = {v, v, v};
    candidate.pair.target = hit.position;
    if (hit.triangle >= 0) {
      candidate.pair.target += Sagitta(target_.cloud().triangles[hit.triangle],
                                       hit.barycentric,
                                       target_.cloud().points,
                                       target_.cloud().normals);
    }
    candidate.distance = std::sqrt(hit.squared_distance);
    candidate.plane = std::abs(candidate.pair.normal.dot(points[v] - candidate.pair.target));
    candidates->push_back(candidate);
  }
  return true;
}

bool FinishMatcher::MatchBackward(const std::vector<Eigen::Vector3d>& points,
                                  const std::vector<Eigen::Vector3d>& normals,
                                  const std::function<bool()>& should_stop,
                                  std::vector<Candidate>* candidates) {
  if (tree_ != nullptr) {
    tree_->Update();
  } else {
    tree_ = std::make_unique<KdTree>(points);
  }
  for (std::size_t i = 0; i < target_samples_.size(); ++i) {
    if (MustStopAt(i, should_stop)) return false;
    const int sample = target_samples_[i];
    const Eigen::Vector3d& position = target_.cloud().points[sample];
    const Neighbor nearest =
        tree_->NearestWithin(position, options_.max_distance, nearest_vertex_[i]);
    nearest_vertex_[i] = nearest.index;
    if (!nearest.found()) continue;
    const int v = nearest.index;
    if (source_.topology().is_border[mesh_.point_of_vertex[v]] != 0) continue;
    Candidate candidate;
    FinishPair& pair = candidate.pair;
    pair.vertices = {v, v, v};
    double best = nearest.squared_distance;
    Eigen::Vector3d closest = points[v];
    for (int e = mesh_.around_offsets[v]; e < mesh_.around_offsets[v + 1]; ++e) {
      const std::array<int, 3>& t = mesh_.triangles[mesh_.around[e]];
      const Eigen::Vector3d blend =
          ClosestPointOnTriangle(position, points[t[0]], points[t[1]], points[t[2]]);
      const Eigen::Vector3d on_triangle =
          blend[0] * points[t[0]] + blend[1] * points[t[1]] + blend[2] * points[t[2]];
      const double squared = (on_triangle - position).squaredNorm();
      if (!(squared < best)) continue;
      best = squared;
      closest = on_triangle;
      pair.vertices = t;
      pair.blend = blend;
    }
    Eigen::Vector3d moving = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) moving += pair.blend[k] * normals[pair.vertices[k]];
    pair.normal = Between(moving.normalized(), target_.cloud().normals[sample]);
    if (pair.normal.isZero(0.0)) continue;
    pair.target = position - Sagitta(pair.vertices, pair.blend, points, normals);
    candidate.distance = std::sqrt(best);
    candidate.plane = std::abs(pair.normal.dot(closest - pair.target));
    candidates->push_back(candidate);
  }
  return true;
}

std::vector<FinishPair> FinishMatcher::Match(const std::vector<Eigen::Vector3d>& points,
                                             double loss_width,
                                             const std::function<bool()>& should_stop) {
  const std::vector<Eigen::Vector3d> normals =
      mesh_.triangles.empty() ? fallback_normals_ : WeldedNormals(mesh_, points);
  std::vector<Candidate> candidates;
  candidates.reserve(points.size() + target_samples_.size());
  if (!MatchForward(points, normals, should_stop, &candidates)) return {};
  const std::size_t forward = candidates.size();
  if (!MatchBackward(points, normals, should_stop, &candidates)) return {};

  std::vector<double> distances;
  std::vector<double> planes;
  for (const Candidate& candidate : candidates) {
    distances.push_back(candidate.distance);
    planes.push_back(candidate.plane);
  }
  const double limit = std::max(options_.resolution,
                                options_.max_deviations * kDeviationPerMedian * Median(distances));
  robust_plane_distance_ = kDeviationPerMedian * Median(std::move(planes));
  const double width = std::max(options_.resolution, loss_width * robust_plane_distance_);
  const double backward_weight =
      0.5 * static_cast<double>(points.size()) / std::max<std::size_t>(1, target_samples_.size());
  std::vector<FinishPair> pairs;
  pairs.reserve(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& candidate = candidates[i];
    if (candidate.distance > limit) continue;
    pairs.push_back(candidate.pair);
    pairs.back().weight = (i < forward ? 0.5 : backward_weight) *
                          std::exp(-0.5 * std::pow(candidate.plane / width, 2));
  }
  return pairs;
}

}  // namespace ceres_ed
