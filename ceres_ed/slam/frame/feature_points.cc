#include "ceres_ed/slam/frame/feature_points.h"

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/slam/frame/pose_from_matches.h>
#include <ceres_ed/util/memory_use.h>
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
// The least and the largest change of area between a template and the present picture.
constexpr double kLeastArea = 0.25;
constexpr double kMostArea = 4.0;
// A corner is compared with so many neighbours, up to this distance (map units); the weight where
// there are fewer than the fewest; and the difference of the motions at which the weight is zero:
// in map units, and relative to the motion.
constexpr std::size_t kWeighingNeighbors = 8;
constexpr double kWeighingDistance = 4.0;
constexpr std::size_t kFewestNeighbors = 3;
constexpr double kLonelyWeight = 0.3;
constexpr double kCoherentWidth = 0.25;
constexpr double kCoherentShare = 0.25;
// Descriptors recognise a place if at least so many matches agree with one pose, to within this
// distance in map units, which leaves room for deformation.
constexpr int kFewestRecognized = 10;
constexpr double kRecognitionTolerance = 0.7;
// The share of the corners that have to be found again for the camera to have moved as expected.
constexpr double kContinuousShare = 0.5;
// Two corners that are closer than this in a picture are one; pixels.
constexpr double kSamePlace = 3.0;

// Computes where the ray of a pixel intersects the plane of its patch. Returns false if there is no
// patch.
bool OnSurface(const ObservedSurface& surface,
               const Eigen::Vector2d& pixel,
               Eigen::Vector3d* point) {
  const SurfacePatch* patch = surface.Find(pixel);
  if (patch == nullptr) return false;
  const Eigen::Vector3d ray = surface.camera().BackProject(pixel.x(), pixel.y(), 1.0);
  const double along = patch->normal.dot(ray);
  if (!(along < -0.1 * ray.norm())) return false;
  *point = ray * (patch->normal.dot(patch->point) / along);
  return true;
}

// Returns how the point where the ray of a pixel meets the plane through `point` changes with the
// pixel: for the ray r(u, v) of depth 1, P = r (n . point) / (n . r).
Eigen::Matrix<double, 3, 2> PlaneFromPixel(const PinholeCamera& camera,
                                           const Eigen::Vector3d& point,
                                           const Eigen::Vector3d& normal) {
  const Eigen::Vector3d ray = point / point.z();
  Eigen::Matrix<double, 3, 2> derivative;
  derivative << 1.0 / camera.fx, 0.0, 0.0, 1.0 / camera.fy, 0.0, 0.0;
  return point.z() * (derivative - ray * (normal.transpose() * derivative) / normal.dot(ray));
}

// Returns how the pixel of a point changes with the point.
Eigen::Matrix<double, 2, 3> PixelFromPoint(const PinholeCamera& camera,
                                           const Eigen::Vector3d& point) {
  const double z = point.z();
  Eigen::Matrix<double, 2, 3> derivative;
  derivative << camera.fx / z, 0.0, -camera.fx * point.x() / (z * z), 0.0, camera.fy / z,
      -camera.fy * point.y() / (z * z);
  return derivative;
}

// Returns the pixels that have a patch.
MaskImage Measured(const ObservedSurface& surface) {
  MaskImage measured(surface.camera().width, surface.camera().height, 0);
  for (int v = 0; v < measured.height(); ++v) {
    for (int i = 0; i < surface.width(); ++i) {
      if (!surface.patch(i, v / surface.cell()).valid()) continue;
      const int end = std::min((i + 1) * surface.cell(), measured.width());
      for (int u = i * surface.cell(); u < end; ++u) measured(u, v) = 1;
    }
  }
  return measured;
}

}  // namespace

FeaturePoints::Prediction FeaturePoints::Predict(const Feature& feature,
                                                 const DeformableMap& map,
                                                 const CameraPose& camera_from_map,
                                                 const PinholeCamera& camera) const {
  Prediction prediction;
  const LocalWarp warp = map.WarpOf(feature.binding());
  prediction.in_camera = camera_from_map * (warp * feature.at_rest);
  if (!(prediction.in_camera.z() > 0.0)) {
    prediction.pixel = feature.pixel;
    return prediction;
  }
  prediction.pixel = camera.Project(prediction.in_camera);
  prediction.now_from_then =
      PixelFromPoint(camera, prediction.in_camera) *
      (camera_from_map.rotation.toRotationMatrix() * warp.gradient * feature.rest_from_pixel);
  const double area = prediction.now_from_then.determinant();
  prediction.comparable = area >= kLeastArea && area <= kMostArea;
  return prediction;
}

bool FeaturePoints::Track(ColorView image,
                          const ObservedSurface& surface,
                          const DeformableMap& map,
                          const CameraPose& camera_from_map) {
  ++frame_;
  tracker_.SetImage(image);
  Follow(surface, map, camera_from_map);
  // Many corners that are new in a picture are never found again, and say nothing about the camera.
  const bool continuous = size() > 0 && size() >= kContinuousShare * num_continued_;
  num_continued_ = size();
  if (continuous) Search(surface, map, camera_from_map, /*patient=*/false);
  Weigh(map, camera_from_map);
  return continuous;
}

void FeaturePoints::Follow(const ObservedSurface& surface,
                           const DeformableMap& map,
                           const CameraPose& camera_from_map) {
  std::vector<Prediction> predictions;
  std::vector<Eigen::Vector2d> before, predicted;
  for (const int index : followed_) {
    predictions.push_back(Predict(features_[index], map, camera_from_map, surface.camera()));
    before.push_back(features_[index].pixel);
    predicted.push_back(predictions.back().pixel);
  }
  std::vector<TrackedPixel> tracked = tracker_.Flow(before, predicted);
  const GrayLevels picture = tracker_.Levels();
  std::vector<std::size_t> unknown;
  for (std::size_t k = 0; k < followed_.size(); ++k) {
    Feature& f = features_[followed_[k]];
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
  for (std::size_t k = 0; k < followed_.size(); ++k) {
    const int index = followed_[k];
    Feature& f = features_[index];
    is_followed_[index] = 0;
    Eigen::Vector3d in_camera;
    if (!tracked[k].found || !OnSurface(surface, tracked[k].pixel, &in_camera)) continue;
    f.pixel = tracked[k].pixel;
    f.in_camera = in_camera;
    is_followed_[index] = 1;
    kept.push_back(index);
  }
  followed_ = std::move(kept);
}

// The method of Lucas and Kanade drifts, so that it may bridge only a few frames in which a corner
// is not recognised.
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
  for (std::size_t n = 0; n < unknown.size(); ++n) {
    const std::size_t k = unknown[n];
    const bool bridged = part[n].found && ++features_[followed_[k]].misses <= kMostBridged;
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
  std::vector<std::pair<int, Prediction>> candidates;
  for (const int node : map.NodesNearView(ViewVolume(camera_from_map, camera))) {
    if (node >= static_cast<int>(of_node_.size())) continue;
    for (const int index : of_node_[node]) {
      // The longer a corner is missed, the rarer it is searched for.
      const Feature& f = features_[index];
      const int pause = patient ? 1 : 1 << std::min(f.misses, kLongestPause);
      if (is_followed_[index] || (frame_ + index) % pause != 0) continue;
      const Prediction p = Predict(f, map, camera_from_map, camera);
      if (!p.comparable) continue;
      const SurfacePatch* patch = surface.Find(p.pixel);
      if (patch == nullptr) continue;
      if (std::abs(patch->normal.dot(p.in_camera - patch->point)) > kNearSurface) continue;
      candidates.emplace_back(index, p);
    }
  }
  const auto first = [&](const auto& a, const auto& b) {
    const Feature& f = features_[a.first];
    const Feature& g = features_[b.first];
    return std::tie(f.misses, f.birth) < std::tie(g.misses, g.birth);
  };
  std::sort(candidates.begin(), candidates.end(), first);
  const std::size_t most = patient ? 4 * kMostRecalled : kMostRecalled;
  if (candidates.size() > most) candidates.resize(most);
  const GrayLevels picture = tracker_.Levels();
  for (const auto& [index, prediction] : candidates) {
    const double reach = std::min(kMostReach, kRecallReach * camera.fx / prediction.in_camera.z());
    Feature& f = features_[index];
    const PatchMatch match =
        FindPatch(f.patch, picture, prediction.pixel, prediction.now_from_then, reach);
    Eigen::Vector3d in_camera;
    if (match.correlation >= kRecognized && OnSurface(surface, match.pixel, &in_camera)) {
      f.pixel = match.pixel;
      f.in_camera = in_camera;
      f.misses = 0;
      is_followed_[index] = 1;
      followed_.push_back(index);
    } else if (!patient && ++f.misses > kMostMisses) {
      Remove(index);
    }
  }
  MergeDoubles();
  return static_cast<int>(candidates.size());
}

// Of followed corners at one place the oldest is kept: it has drifted least.
void FeaturePoints::MergeDoubles() {
  std::vector<int> order = followed_;
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return features_[a].birth < features_[b].birth;
  });
  std::vector<int> kept;
  // Corners by cells of the picture that are as large as a place.
  std::map<std::pair<int, int>, std::vector<int>> cells;
  for (const int index : order) {
    const Eigen::Vector2d& pixel = features_[index].pixel;
    const int i = static_cast<int>(std::floor(pixel.x() / kSamePlace));
    const int j = static_cast<int>(std::floor(pixel.y() / kSamePlace));
    bool taken = false;
    for (int dj = -1; dj <= 1 && !taken; ++dj) {
      for (int di = -1; di <= 1 && !taken; ++di) {
        const auto cell = cells.find({i + di, j + dj});
        if (cell == cells.end()) continue;
        taken = std::any_of(cell->second.begin(), cell->second.end(), [&](int other) {
          return (features_[other].pixel - pixel).norm() < kSamePlace;
        });
      }
    }
    if (taken) {
      is_followed_[index] = 0;
      Remove(index);
    } else {
      cells[{i, j}].push_back(index);
      kept.push_back(index);
    }
  }
  followed_ = std::move(kept);
}

// The motion that the map does not predict yet is that of the camera and of the tissue, and both
// are smooth: the motion of a corner that is right differs little from the median of its
// neighbours. So a part of the tissue that moves on its own is followed as a whole, however far it
// moves, and a corner that was confused with another one is not.
void FeaturePoints::Weigh(const DeformableMap& map, const CameraPose& camera_from_map) {
  const std::vector<PointMatch> matches = Matches(map);
  std::vector<Eigen::Vector3d> motions;
  motions.reserve(matches.size());
  for (const PointMatch& m : matches) motions.push_back(m.in_camera - camera_from_map * m.in_map);
  std::vector<std::pair<double, std::size_t>> order(matches.size());
  std::array<std::vector<double>, 3> near;
  for (std::size_t k = 0; k < matches.size(); ++k) {
    for (std::size_t n = 0; n < matches.size(); ++n) {
      order[n] = {(matches[n].in_map - matches[k].in_map).squaredNorm(), n};
    }
    // The corner itself is the nearest one.
    const std::size_t count = std::min<std::size_t>(kWeighingNeighbors + 1, order.size());
    std::partial_sort(
        order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end());
    for (std::vector<double>& values : near) values.clear();
    for (std::size_t n = 1; n < count; ++n) {
      if (order[n].first > kWeighingDistance * kWeighingDistance) break;
      for (int axis = 0; axis < 3; ++axis) near[axis].push_back(motions[order[n].second][axis]);
    }
    Feature& f = features_[followed_[k]];
    f.weight = kLonelyWeight;
    if (near[0].size() < kFewestNeighbors) continue;
    Eigen::Vector3d median;
    for (int axis = 0; axis < 3; ++axis) median[axis] = Median(near[axis]);
    const double width = kCoherentWidth + kCoherentShare * median.norm();
    const double x = (motions[k] - median).norm() / width;
    f.weight = x < 1.0 ? (1.0 - x * x) * (1.0 - x * x) : 0.0;
  }
}

void FeaturePoints::Remove(int index) {
  Feature& f = features_[index];
  std::vector<int>& list = of_node_[f.nodes[0]];
  list.erase(std::find(list.begin(), list.end(), index));
  f = Feature();
  free_.insert(index);
}

void FeaturePoints::Add(const Feature& feature) {
  int index = static_cast<int>(features_.size());
  if (free_.empty()) {
    features_.emplace_back();
    is_followed_.push_back(0);
  } else {
    // The lowest one, so that a loaded state goes on like the saved one.
    index = *free_.begin();
    free_.erase(free_.begin());
  }
  features_[index] = feature;
  features_[index].birth = births_++;
  is_followed_[index] = 1;
  followed_.push_back(index);
  const int node = feature.nodes[0];
  if (node >= static_cast<int>(of_node_.size())) of_node_.resize(node + 1);
  of_node_[node].push_back(index);
}

void FeaturePoints::Index() {
  const auto outside = [&](int index) {
    return index < 0 || index >= static_cast<int>(features_.size());
  };
  followed_.erase(std::remove_if(followed_.begin(), followed_.end(), outside), followed_.end());
  is_followed_.assign(features_.size(), 0);
  for (const int index : followed_) is_followed_[index] = 1;
  free_.clear();
  of_node_.clear();
  for (int index = 0; index < static_cast<int>(features_.size()); ++index) {
    const Feature& f = features_[index];
    if (f.num_nodes == 0) {
      free_.insert(index);
      continue;
    }
    if (f.nodes[0] >= static_cast<int>(of_node_.size())) of_node_.resize(f.nodes[0] + 1);
    of_node_[f.nodes[0]].push_back(index);
  }
}

void FeaturePoints::Clear() {
  num_continued_ = 0;
  std::fill(is_followed_.begin(), is_followed_.end(), 0);
  followed_.clear();
}

std::size_t FeaturePoints::HeapBytes() const {
  return HeapBytesOf(features_) + HeapBytesOf(is_followed_) + HeapBytesOfAll(of_node_);
}

std::vector<PointMatch> FeaturePoints::Matches(const DeformableMap& map) const {
  std::vector<PointMatch> matches;
  for (const int index : followed_) {
    const Feature& f = features_[index];
    matches.push_back(
        {WarpPoint(map.graph(), map.state(), f.binding(), f.at_rest), f.in_camera, f.weight});
  }
  return matches;
}

std::vector<MapObservation> FeaturePoints::Observations() const {
  std::vector<MapObservation> observations;
  for (const int index : followed_) {
    const Feature& f = features_[index];
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
  std::vector<int> kept;
  for (std::size_t k = 0; k < followed_.size(); ++k) {
    const int index = followed_[k];
    if (distances[k] <= options_.max_deviations * deviation) {
      kept.push_back(index);
      continue;
    }
    is_followed_[index] = 0;
    if (++features_[index].misses > kMostMisses) Remove(index);
  }
  followed_ = std::move(kept);
  return deviation;
}

std::optional<CameraPose> FeaturePoints::Recognize(const ObservedSurface& surface,
                                                   const DeformableMap& map) const {
  std::vector<Eigen::Vector3d> in_camera, in_map;
  std::vector<Eigen::Vector2d> pixels;
  for (const Eigen::Vector2d& pixel :
       tracker_.Detect(Measured(surface), /*taken=*/{}, options_.count)) {
    Eigen::Vector3d point;
    if (!OnSurface(surface, pixel, &point)) continue;
    pixels.push_back(pixel);
    in_camera.push_back(point);
  }
  std::vector<CornerDescriptor> known;
  for (const Feature& f : features_) {
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
  const MaskImage allowed = Measured(surface);
  std::vector<Eigen::Vector2d> taken;
  for (const int index : followed_) taken.push_back(features_[index].pixel);
  const CameraPose& camera_from_map = map.state().camera_from_map;
  const GrayLevels picture = tracker_.Levels();
  PlaceBinder binder(map, camera_from_map, surface.camera());
  if (binder.empty()) return;
  const std::vector<Eigen::Vector2d> found =
      tracker_.Detect(allowed, taken, options_.count - size());
  const std::vector<CornerDescriptor> descriptors = DescribeCorners(picture[0], found);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Eigen::Vector2d& pixel = found[k];
    Feature f;
    f.pixel = pixel;
    f.descriptor = descriptors[k];
    if (!OnSurface(surface, pixel, &f.in_camera)) continue;
    if (!PatchTemplate::Cut(picture, pixel, &f.patch)) continue;
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
    Add(f);
  }
}

}  // namespace ceres_ed
