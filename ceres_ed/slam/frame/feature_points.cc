#include "ceres_ed/slam/frame/feature_points.h"

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/slam/frame/corner_geometry.h>
#include <ceres_ed/slam/frame/corner_weights.h>
#include <ceres_ed/slam/frame/pose_from_matches.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include <Eigen/LU>

namespace ceres_ed {
namespace {

// New corners are searched when fewer than this share of the wanted number is left.
constexpr double kReplenishBelow = 0.8;
// The correlation at which a template is recognised: near a pixel that was followed, and after a
// search.
constexpr double kAlike = 0.75;
constexpr double kRecognized = 0.85;
// The reach in pixels of the search for a corner that was seen in the frame before, and the number
// of frames in which it may be followed without being recognised.
constexpr double kFollowReach = 6.0;
constexpr int kMostBridged = 2;
// A corner that is this far from where it was predicted moves in a way that the map does not know,
// in pixels: more than the method of Lucas and Kanade drifts in these frames.
constexpr double kUnforeseen = 2.0;
// It does so with its neighbours, or it is an error: the weight that tells.
constexpr double kCoherent = 0.5;
// The most corners that are searched for in a frame, how often in vain before they are forgotten,
// and the reach of the search in map units and in pixels.
constexpr std::size_t kMostRecalled = 60;
constexpr int kMostMisses = 8;
constexpr int kLongestPause = 4;
constexpr double kRecallReach = 0.5;
constexpr double kMostReach = 12.0;
// A corner is searched for on the observed surface if that is not farther away than this, in map
// units.
constexpr double kNearSurface = 1.5;
// Descriptors recognise a place if at least so many matches agree with one pose, to within this
// distance in map units, which leaves room for deformation.
constexpr int kFewestRecognized = 10;
constexpr double kRecognitionTolerance = 0.7;
// So many times the wanted number of corners are described in a picture: not the same ones are
// found in every picture.
constexpr int kRecognizeAmong = 2;
// The share of the corners that have to be found again for the camera to have moved as expected.
constexpr double kContinuousShare = 0.5;
// Two corners that are closer than this in a picture are one; pixels.
constexpr double kSamePlace = 3.0;
// What lies farther than this from the tangent plane at a corner, in map units, is another surface;
// and the share of a template that has to be left without it.
constexpr double kOneSurface = 0.5;
constexpr double kLeastTemplate = 0.5;

// Leaves in a template only what belongs to the surface at its middle. Returns false if too little
// is left to recognise the place by.
bool KeepOneSurface(const ObservedSurface& surface,
                    const Eigen::Vector2d& pixel,
                    PatchTemplate* patch) {
  const SurfacePatch* middle = surface.Find(pixel);
  if (middle == nullptr) return false;
  const auto belongs = [&](const Eigen::Vector2d& place) {
    const SurfacePatch* there = surface.Find(place);
    return there != nullptr &&
           std::abs(middle->normal.dot(there->point - middle->point)) <= kOneSurface;
  };
  return patch->Keep(pixel, belongs) >= kLeastTemplate;
}

// Returns the median of how far the tracked corners are from where they were predicted: the error
// of the predicted camera.
Eigen::Vector2d CommonOffset(const std::vector<Eigen::Vector2d>& predicted,
                             const std::vector<TrackedPixel>& tracked) {
  std::vector<double> u, v;
  for (std::size_t k = 0; k < tracked.size(); ++k) {
    if (!tracked[k].found) continue;
    u.push_back(tracked[k].pixel.x() - predicted[k].x());
    v.push_back(tracked[k].pixel.y() - predicted[k].y());
  }
  return {Median(std::move(u)), Median(std::move(v))};
}

}  // namespace

bool FeaturePoints::Track(ColorView image,
                          const ObservedSurface& surface,
                          const DeformableMap& map,
                          const CameraPose& camera_from_map) {
  ++frame_;
  tracker_.SetImage(image, Measured(surface));
  Follow(surface, map, camera_from_map);
  tracker_.ForgetPrevious();
  // Many corners that are new in a picture are never found again, and say nothing about the camera.
  const bool continuous = size() > 0 && size() >= kContinuousShare * num_continued_;
  num_continued_ = size();
  if (continuous) Search(surface, map, camera_from_map, /*patient=*/false);
  Weigh(map, camera_from_map);
  return continuous;
}

void FeaturePoints::Weigh(const DeformableMap& map, const CameraPose& camera_from_map) {
  const std::vector<double> weights = WeighCorners(Matches(map), camera_from_map);
  for (std::size_t k = 0; k < weights.size(); ++k) {
    corners_[corners_.followed()[k]].weight = weights[k];
  }
}

void FeaturePoints::Follow(const ObservedSurface& surface,
                           const DeformableMap& map,
                           const CameraPose& camera_from_map) {
  std::vector<CornerPrediction> predictions;
  std::vector<Eigen::Vector2d> before, predicted;
  for (const int index : corners_.followed()) {
    predictions.push_back(PredictCorner(corners_[index], map, camera_from_map, surface.camera()));
    before.push_back(corners_[index].pixel);
    predicted.push_back(predictions.back().pixel);
  }
  std::vector<TrackedPixel> tracked = tracker_.Flow(before, predicted);
  const GrayLevels picture = tracker_.Levels();
  std::vector<std::size_t> unknown;
  for (std::size_t k = 0; k < corners_.followed().size(); ++k) {
    Corner& f = corners_[corners_.followed()[k]];
    PatchMatch match;
    if (predictions[k].comparable) {
      const Eigen::Matrix2d& now_from_then = predictions[k].now_from_then;
      if (tracked[k].found) {
        match = FindPatch(f.patch, picture, tracked[k].pixel, now_from_then, /*reach=*/0.0);
      }
      if (match.correlation < kAlike) {
        match = FindPatch(f.patch, picture, predicted[k], now_from_then, kFollowReach);
      }
    }
    if (match.correlation >= kAlike) {
      f.misses = 0;
      tracked[k] = {match.pixel, true};
    } else {
      unknown.push_back(k);
    }
  }
  Bridge(before, predicted, unknown, &tracked);
  std::vector<int> kept;
  for (std::size_t k = 0; k < corners_.followed().size(); ++k) {
    const int index = corners_.followed()[k];
    Corner& f = corners_[index];
    Eigen::Vector3d in_camera;
    if (!tracked[k].found || !OnSurface(surface, tracked[k].pixel, &in_camera)) continue;
    f.pixel = tracked[k].pixel;
    f.in_camera = in_camera;
    kept.push_back(index);
  }
  corners_.FollowOnly(std::move(kept));
}

// The method of Lucas and Kanade drifts, so that it may bridge only a few frames in which a corner
// is not recognised. It may bridge more where tissue moves as nobody foresaw, as when it is pulled:
// even a place that is uncertain by a pixel then says more than the map, which would stay behind.
void FeaturePoints::Bridge(const std::vector<Eigen::Vector2d>& before,
                           const std::vector<Eigen::Vector2d>& predicted,
                           const std::vector<std::size_t>& unknown,
                           std::vector<TrackedPixel>* tracked) {
  std::vector<Eigen::Vector2d> part_before, part_predicted;
  std::vector<TrackedPixel> part;
  for (const std::size_t k : unknown) {
    part_before.push_back(before[k]);
    part_predicted.push_back(predicted[k]);
    part.push_back((*tracked)[k]);
  }
  tracker_.CheckReturn(part_before, part_predicted, &part);
  const Eigen::Vector2d common = CommonOffset(predicted, *tracked);
  for (std::size_t n = 0; n < unknown.size(); ++n) {
    const std::size_t k = unknown[n];
    const double offset = (part[n].pixel - part_predicted[n] - common).norm();
    Corner& f = corners_[corners_.followed()[k]];
    const bool is_pulled = offset > kUnforeseen && f.weight > kCoherent;
    const bool bridged = part[n].found && (++f.misses <= kMostBridged || is_pulled);
    (*tracked)[k].found = bridged;
  }
}

// Searches for corners of nodes near the view that are not followed, those first that were missed
// least often and are oldest.
int FeaturePoints::Search(const ObservedSurface& surface,
                          const DeformableMap& map,
                          const CameraPose& camera_from_map,
                          bool patient) {
  const PinholeCamera& camera = surface.camera();
  std::vector<std::pair<int, CornerPrediction>> candidates;
  for (const int node : map.NodesNearView(ViewVolume(camera_from_map, camera))) {
    for (const int index : corners_.OfNode(node)) {
      // The longer a corner is missed, the rarer it is searched for.
      const Corner& f = corners_[index];
      const int pause = patient ? 1 : 1 << std::min(f.misses, kLongestPause);
      if (corners_.IsFollowed(index) || (frame_ + index) % pause != 0) continue;
      const CornerPrediction p = PredictCorner(f, map, camera_from_map, camera);
      if (!p.comparable) continue;
      const SurfacePatch* patch = surface.Find(p.pixel);
      if (patch == nullptr) continue;
      if (std::abs(patch->normal.dot(p.in_camera - patch->point)) > kNearSurface) continue;
      candidates.emplace_back(index, p);
    }
  }
  const auto first = [&](const auto& a, const auto& b) {
    const Corner& f = corners_[a.first];
    const Corner& g = corners_[b.first];
    return std::tie(f.misses, f.birth) < std::tie(g.misses, g.birth);
  };
  std::sort(candidates.begin(), candidates.end(), first);
  const std::size_t most = patient ? 4 * kMostRecalled : kMostRecalled;
  if (candidates.size() > most) candidates.resize(most);
  const GrayLevels picture = tracker_.Levels();
  for (const auto& [index, prediction] : candidates) {
    const double reach = std::min(kMostReach, kRecallReach * camera.fx / prediction.in_camera.z());
    Corner& f = corners_[index];
    const PatchMatch match =
        FindPatch(f.patch, picture, prediction.pixel, prediction.now_from_then, reach);
    Eigen::Vector3d in_camera;
    if (match.correlation >= kRecognized && OnSurface(surface, match.pixel, &in_camera)) {
      f.pixel = match.pixel;
      f.in_camera = in_camera;
      f.misses = 0;
      corners_.Follow(index);
    } else if (!patient && ++f.misses > kMostMisses) {
      corners_.Remove(index);
    }
  }
  MergeDoubles();
  return static_cast<int>(candidates.size());
}

// Of followed corners at one place the oldest is kept: it has drifted least.
void FeaturePoints::MergeDoubles() {
  std::vector<int> order = corners_.followed();
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return corners_[a].birth < corners_[b].birth;
  });
  std::vector<int> kept, doubles;
  // Corners by cells of the picture that are as large as a place.
  std::map<std::pair<int, int>, std::vector<int>> cells;
  for (const int index : order) {
    const Eigen::Vector2d& pixel = corners_[index].pixel;
    const int i = static_cast<int>(std::floor(pixel.x() / kSamePlace));
    const int j = static_cast<int>(std::floor(pixel.y() / kSamePlace));
    bool taken = false;
    for (int dj = -1; dj <= 1 && !taken; ++dj) {
      for (int di = -1; di <= 1 && !taken; ++di) {
        const auto cell = cells.find({i + di, j + dj});
        if (cell == cells.end()) continue;
        taken = std::any_of(cell->second.begin(), cell->second.end(), [&](int other) {
          return (corners_[other].pixel - pixel).norm() < kSamePlace;
        });
      }
    }
    if (taken) {
      doubles.push_back(index);
    } else {
      cells[{i, j}].push_back(index);
      kept.push_back(index);
    }
  }
  corners_.FollowOnly(std::move(kept));
  for (const int index : doubles) corners_.Remove(index);
}

void FeaturePoints::Clear() {
  num_continued_ = 0;
  corners_.FollowOnly({});
}

std::vector<PointMatch> FeaturePoints::Matches(const DeformableMap& map) const {
  std::vector<PointMatch> matches;
  for (const int index : corners_.followed()) {
    const Corner& f = corners_[index];
    matches.push_back(
        {WarpPoint(map.graph(), map.state(), f.binding(), f.at_rest), f.in_camera, f.weight});
  }
  return matches;
}

std::vector<MapObservation> FeaturePoints::Observations() const {
  std::vector<MapObservation> observations;
  for (const int index : corners_.followed()) {
    const Corner& f = corners_[index];
    MapObservation o;
    o.position = f.at_rest;
    o.binding = PointBinding(f.binding());
    o.target = f.in_camera;
    o.weight = f.weight;
    observations.push_back(o);
  }
  return observations;
}

double FeaturePoints::DropOutliers(const DeformableMap& map, double least_deviation) {
  std::vector<double> distances;
  for (const PointMatch& m : Matches(map)) {
    distances.push_back((map.state().camera_from_map * m.in_map - m.in_camera).norm());
  }
  const double deviation = std::max(RobustDeviation(distances), least_deviation);
  std::vector<int> kept, gone;
  for (std::size_t k = 0; k < corners_.followed().size(); ++k) {
    const int index = corners_.followed()[k];
    if (distances[k] <= options_.max_deviations * deviation) {
      kept.push_back(index);
      continue;
    }
    if (++corners_[index].misses > kMostMisses) gone.push_back(index);
  }
  corners_.FollowOnly(std::move(kept));
  for (const int index : gone) corners_.Remove(index);
  return deviation;
}

std::optional<CameraPose> FeaturePoints::Recognize(const ObservedSurface& surface,
                                                   const DeformableMap& map) const {
  std::vector<Eigen::Vector3d> in_camera, in_map;
  std::vector<Eigen::Vector2d> pixels;
  for (const Eigen::Vector2d& pixel :
       tracker_.Detect(Measured(surface), /*taken=*/{}, kRecognizeAmong * options_.count)) {
    Eigen::Vector3d point;
    if (!OnSurface(surface, pixel, &point)) continue;
    pixels.push_back(pixel);
    in_camera.push_back(point);
  }
  std::vector<CornerDescriptor> known;
  for (int slot = 0; slot < corners_.num_slots(); ++slot) {
    const Corner& f = corners_[slot];
    if (f.num_nodes == 0) continue;
    known.push_back(f.descriptor);
    in_map.push_back(WarpPoint(map.graph(), map.state(), f.binding(), f.at_rest));
  }
  std::vector<PointMatch> matches;
  for (const auto& [seen, remembered] :
       MatchDescriptors(DescribeCorners(tracker_.Levels()[0], pixels), known)) {
    matches.push_back({in_map[remembered], in_camera[seen]});
  }
  return PoseFromMatches(matches, kRecognitionTolerance, kFewestRecognized);
}

void FeaturePoints::Replenish(const ObservedSurface& surface, const DeformableMap& map) {
  if (size() >= kReplenishBelow * options_.count) return;
  const MaskImage allowed = Measured(surface, PatchTemplate::kMargin);
  std::vector<Eigen::Vector2d> taken;
  for (const int index : corners_.followed()) taken.push_back(corners_[index].pixel);
  const CameraPose& camera_from_map = map.state().camera_from_map;
  const GrayLevels picture = tracker_.Levels();
  PlaceBinder binder(map, camera_from_map, surface.camera());
  if (binder.empty()) return;
  const std::vector<Eigen::Vector2d> found =
      tracker_.Detect(allowed, taken, options_.count - size());
  const std::vector<CornerDescriptor> descriptors = DescribeCorners(picture[0], found);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Eigen::Vector2d& pixel = found[k];
    Corner f;
    f.pixel = pixel;
    f.descriptor = descriptors[k];
    if (!OnSurface(surface, pixel, &f.in_camera)) continue;
    if (!PatchTemplate::Cut(picture, pixel, &f.patch)) continue;
    if (!KeepOneSurface(surface, pixel, &f.patch)) continue;
    const Eigen::Vector3d place = camera_from_map.ApplyInverse(f.in_camera);
    if (binder.DistanceTo(place) > 1.5) continue;
    const Binding binding = binder.Bind(place, map.neighbors());
    const LocalWarp warp = map.WarpOf(binding);
    if (!warp.IsInvertible()) continue;
    f.at_rest = warp.AtRest(place);
    const Eigen::Vector3d& normal = surface.Find(pixel)->normal;
    f.rest_from_pixel = warp.gradient.inverse() *
                        camera_from_map.rotation.conjugate().toRotationMatrix() *
                        PlaneFromPixel(surface.camera(), f.in_camera, normal);
    f.num_nodes = binding.size;
    std::copy_n(binding.nodes, binding.size, f.nodes);
    std::copy_n(binding.weights, binding.size, f.weights);
    corners_.Add(f);
  }
}

}  // namespace ceres_ed
