#include "ceres_ed/evaluation/track_following.h"

#include <ceres_ed/geometry/visibility_buffer.h>

#include <algorithm>
#include <cstddef>
#include <unordered_map>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// The smallest distance for the weights, in pixels. Without this lower bound, one near map point
// could take all the weight, and its noise would decide.
constexpr double kMinWeightDistance = 0.5;

}  // namespace

TrackFollower::TrackFollower(const PinholeCamera& camera,
                             const std::vector<TrackObservation>& observations,
                             const TrackFollowingOptions& options)
    : camera_(camera), options_(options) {
  CHECK_GE(options.neighbors, 1);
  CHECK_GT(options.max_distance, 0.0);
  for (const TrackObservation& observation : observations) {
    observations_of_frame_[observation.frame].push_back(observation);
  }
}

std::vector<TrackFollower::Candidate> TrackFollower::SeenPoints(
    const LiveSnapshot& snapshot) const {
  VisibilityBuffer buffer(camera_);
  buffer.AddPoints(snapshot.points);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (!buffer.Sees(snapshot.points[i], options_.visibility.visibility_tolerance)) continue;
    candidates.push_back({snapshot.ids[i], camera_.Project(snapshot.points[i])});
  }
  return candidates;
}

void TrackFollower::TieTo(const std::vector<Candidate>& candidates,
                          const Eigen::Vector2d& pixel,
                          Track* track) const {
  std::vector<std::pair<double, const Candidate*>> near;
  for (const Candidate& candidate : candidates) {
    const double distance = (candidate.pixel - pixel).norm();
    if (distance <= options_.max_distance) near.push_back({distance, &candidate});
  }
  std::sort(near.begin(), near.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second->id < b.second->id;
  });
  if (near.size() > static_cast<std::size_t>(options_.neighbors)) near.resize(options_.neighbors);
  track->start = pixel;
  for (const auto& [distance, candidate] : near) {
    const double weight = 1.0 / std::max(distance, kMinWeightDistance);
    track->ties.push_back({candidate->id, weight, candidate->pixel});
  }
}

std::optional<Eigen::Vector2d> TrackFollower::PredictTrack(
    const Track& track,
    const LiveSnapshot& snapshot,
    const std::unordered_map<int, std::size_t>& index_of_id) const {
  Eigen::Vector2d displacement = Eigen::Vector2d::Zero();
  double weight = 0.0;
  for (const Tie& tie : track.ties) {
    const auto index = index_of_id.find(tie.id);
    if (index == index_of_id.end()) continue;
    const Eigen::Vector3d& point = snapshot.points[index->second];
    if (!(point.z() > 0.0)) continue;
    displacement += tie.weight * (camera_.Project(point) - tie.pixel);
    weight += tie.weight;
  }
  if (weight == 0.0) return std::nullopt;
  return track.start + displacement / weight;
}

std::vector<Eigen::Vector2d> TrackFollower::Predict(const LiveSnapshot& snapshot) const {
  std::unordered_map<int, std::size_t> index_of_id;
  for (std::size_t i = 0; i < snapshot.size(); ++i) index_of_id.emplace(snapshot.ids[i], i);
  std::vector<Eigen::Vector2d> pixels;
  for (const auto& [number, track] : tracks_) {
    const std::optional<Eigen::Vector2d> pixel = PredictTrack(track, snapshot, index_of_id);
    if (pixel.has_value()) pixels.push_back(*pixel);
  }
  return pixels;
}

void TrackFollower::Add(const LiveSnapshot& snapshot) {
  CHECK(frames_.empty() || frames_.back().frame < snapshot.frame) << snapshot.frame;
  frames_.emplace_back();
  TrackFrameError& frame = frames_.back();
  frame.frame = snapshot.frame;
  const auto found = observations_of_frame_.find(snapshot.frame);
  if (found == observations_of_frame_.end()) return;
  std::unordered_map<int, std::size_t> index_of_id;
  for (std::size_t i = 0; i < snapshot.size(); ++i) index_of_id.emplace(snapshot.ids[i], i);
  std::optional<std::vector<Candidate>> candidates;
  std::vector<double> errors;
  for (const TrackObservation& observation : found->second) {
    Track& track = tracks_[observation.track];
    if (track.ties.empty()) {
      if (!candidates) candidates = SeenPoints(snapshot);
      TieTo(*candidates, observation.pixel, &track);
      track.late = track.given && !track.ties.empty();
      track.given = true;
      continue;
    }
    ++frame.tracks;
    track.motion = std::max(track.motion, (observation.pixel - track.start).norm());
    const std::optional<Eigen::Vector2d> predicted = PredictTrack(track, snapshot, index_of_id);
    if (!predicted.has_value()) {
      ++frame.lost;
      track.lost = true;
      continue;
    }
    errors.push_back((*predicted - observation.pixel).norm());
    track.last_error = errors.back();
  }
  if (!errors.empty()) frame.error = Summarize(errors);
  errors_.insert(errors_.end(), errors.begin(), errors.end());
}

TrackEvaluation TrackFollower::Evaluate() const {
  TrackEvaluation evaluation;
  std::vector<double> moved;
  for (const auto& [number, track] : tracks_) {
    ++evaluation.tracks;
    if (!track.ties.empty()) ++evaluation.followed;
    if (track.late) ++evaluation.late;
    if (track.lost) ++evaluation.lost;
    if (!(track.motion > options_.moved_distance)) continue;
    ++evaluation.moved;
    if (track.last_error) moved.push_back(*track.last_error);
  }
  if (!moved.empty()) evaluation.moved_error = Summarize(std::move(moved));
  if (!errors_.empty()) evaluation.error = Summarize(errors_);
  evaluation.frames = frames_;
  return evaluation;
}

}  // namespace ceres_ed
