#include "ceres_ed/slam/frame/feature_points.h"

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ceres_ed {
namespace {

// New corners are searched when fewer than this share of the wanted number is left.
constexpr double kReplenishBelow = 0.8;

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

void FeaturePoints::Track(ColorView image,
                          const ObservedSurface& surface,
                          const DeformableMap& map,
                          const CameraPose& camera_from_map) {
  tracker_.SetImage(image);
  std::vector<Eigen::Vector2d> before, predicted;
  for (const Feature& f : features_) {
    before.push_back(f.pixel);
    const Eigen::Vector3d x =
        camera_from_map * WarpPoint(map.graph(), map.state(), f.binding(), f.at_rest);
    predicted.push_back(x.z() > 0.0 ? surface.camera().Project(x) : f.pixel);
  }
  const std::vector<TrackedPixel> tracked = tracker_.Track(before, predicted);
  std::vector<Feature> kept;
  for (std::size_t k = 0; k < features_.size(); ++k) {
    Feature f = features_[k];
    f.pixel = tracked[k].pixel;
    if (!tracked[k].found || !OnSurface(surface, f.pixel, &f.in_camera)) continue;
    kept.push_back(f);
  }
  features_ = std::move(kept);
}

std::vector<PointMatch> FeaturePoints::Matches(const DeformableMap& map) const {
  std::vector<PointMatch> matches;
  for (const Feature& f : features_) {
    matches.push_back({WarpPoint(map.graph(), map.state(), f.binding(), f.at_rest), f.in_camera});
  }
  return matches;
}

std::vector<MapObservation> FeaturePoints::Observations() const {
  std::vector<MapObservation> observations;
  for (const Feature& f : features_) {
    MapObservation o;
    o.position = f.at_rest;
    o.binding = PointBinding(f.binding());
    o.target = f.in_camera;
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
  std::vector<Feature> kept;
  for (std::size_t k = 0; k < features_.size(); ++k) {
    if (distances[k] <= options_.max_deviations * deviation) kept.push_back(features_[k]);
  }
  features_ = std::move(kept);
  return deviation;
}

void FeaturePoints::Replenish(const ObservedSurface& surface, const DeformableMap& map) {
  if (size() >= kReplenishBelow * options_.count) return;
  const MaskImage allowed = Measured(surface);
  std::vector<Eigen::Vector2d> taken;
  for (const Feature& f : features_) taken.push_back(f.pixel);
  const CameraPose& camera_from_map = map.state().camera_from_map;
  PlaceBinder binder(map, camera_from_map, surface.camera());
  if (binder.empty()) return;
  for (const Eigen::Vector2d& pixel : tracker_.Detect(allowed, taken, options_.count - size())) {
    Feature f;
    f.pixel = pixel;
    if (!OnSurface(surface, pixel, &f.in_camera)) continue;
    const Eigen::Vector3d place = camera_from_map.ApplyInverse(f.in_camera);
    if (binder.DistanceTo(place) > 1.5) continue;
    const Binding binding = binder.Bind(place, map.neighbors());
    const LocalWarp warp = map.WarpOf(binding);
    if (!warp.IsInvertible()) continue;
    f.at_rest = warp.AtRest(place);
    f.num_nodes = binding.size;
    std::copy_n(binding.nodes, binding.size, f.nodes);
    std::copy_n(binding.weights, binding.size, f.weights);
    features_.push_back(f);
  }
}

}  // namespace ceres_ed
