#include "ceres_ed/report/view/fit_view.h"

#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/report/view/seen_points.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace ceres_ed {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
// The unit of files is not known.
constexpr char kLength[] = "file units";

std::vector<double> Lengths(const std::vector<Eigen::Vector3d>& from,
                            const std::vector<Eigen::Vector3d>& to) {
  std::vector<double> lengths(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) lengths[i] = (to[i] - from[i]).norm();
  return lengths;
}

// Builds the view of one fit.
class FitViewBuilder {
 public:
  explicit FitViewBuilder(const FitParts& parts) : parts_(parts) {}

  FitView Build();

 private:
  bool has_target() const { return parts_.target != nullptr && !parts_.target->empty(); }
  void Place();
  void Measure();
  void AddSource();
  void AddMotion(ViewSurface* source);
  void AddFields(ViewSurface* source) const;
  void AddTarget();
  void AddGraph();
  void AddLandmarks();
  void AddPanels();
  void AddField(const char* key,
                const char* name,
                const char* unit,
                const std::vector<double>& of_all,
                ViewSurface* surface,
                ColorScale scale = ColorScale::kMagnitude) const;

  const FitParts& parts_;
  FitView view_;
  std::vector<Eigen::Vector3d> placed_;
  // The points of the source that are shown.
  std::vector<int> kept_;
  // 1 for points of the result that the target does not show; empty without a target.
  std::vector<char> not_shown_;
};

// Finds the rigidly placed source.
void FitViewBuilder::Place() {
  if (parts_.source == nullptr) return;
  const Similarity* rigid =
      parts_.warp != nullptr ? &parts_.warp->target_from_source : parts_.rigid;
  if (rigid == nullptr) return;
  placed_ = parts_.source->points;
  for (Eigen::Vector3d& point : placed_) point = *rigid * point;
}

void FitViewBuilder::Measure() {
  FitDistances& distances = view_.distances;
  const std::vector<Eigen::Vector3d>& result = *parts_.result;
  if (has_target()) {
    // One search structure for both.
    std::vector<Eigen::Vector3d> queries = result;
    queries.insert(queries.end(), placed_.begin(), placed_.end());
    const std::vector<double> found = SurfaceDistances(queries, *parts_.target);
    const auto end = found.begin() + static_cast<std::ptrdiff_t>(result.size());
    distances.to_target.assign(found.begin(), end);
    distances.rigid_to_target.assign(end, found.end());
    PointCloud cloud;
    cloud.points = result;
    if (parts_.triangles != nullptr) cloud.triangles = *parts_.triangles;
    distances.from_target = SurfaceDistances(parts_.target->points, cloud);
    not_shown_ = PointsNotShown(cloud, *parts_.target);
  }
  if (parts_.truth != nullptr) {
    distances.to_truth = Lengths(result, *parts_.truth);
    if (!placed_.empty()) distances.rigid_to_truth = Lengths(placed_, *parts_.truth);
  }
}

void FitViewBuilder::AddField(const char* key,
                              const char* name,
                              const char* unit,
                              const std::vector<double>& of_all,
                              ViewSurface* surface,
                              ColorScale scale) const {
  if (of_all.empty()) return;
  surface->fields.push_back({key, name, unit, scale, TakeKept(of_all, kept_), {}});
}

void FitViewBuilder::AddMotion(ViewSurface* source) {
  std::vector<Eigen::Vector3d> result;
  for (const int point : kept_) result.push_back((*parts_.result)[point]);
  if (parts_.warp != nullptr && parts_.skinning != nullptr) {
    source->motion = MakeWarpMotion(*parts_.warp, *parts_.skinning, parts_.source->points, kept_);
    const std::vector<double> gaps = Lengths(PointsAt(*source, 1.0), result);
    constexpr double kTolerance = 1e-3;
    const double gap = gaps.empty() ? 0.0 : *std::max_element(gaps.begin(), gaps.end());
    if (gap <= kTolerance * Diagonal(result)) return;
    view_.scene.notes.emplace_back(
        "The warp does not lead to the result, so points move along straight lines between source "
        "and result.");
  } else {
    view_.scene.notes.emplace_back(
        "There is no warp, so points move along straight lines between source and result.");
  }
  source->motion = StraightMotion(source->points, result);
}

void FitViewBuilder::AddFields(ViewSurface* source) const {
  const FitDistances& distances = view_.distances;
  AddField("distance", "distance to the other surface", kLength, distances.to_target, source);
  AddField("truth", "distance to the true place", kLength, distances.to_truth, source);
  // What the target does not show has no distance to it, and its true error, which may be many
  // times as large, must not make all that is seen look alike.
  for (ScalarField& field : source->fields) {
    if (not_shown_.empty()) break;
    for (const int point : kept_) field.aside.push_back(not_shown_[point]);
    field.hides_aside = field.key == "distance";
  }
  if (parts_.source != nullptr) {
    const bool has_faces = parts_.triangles != nullptr && !parts_.triangles->empty();
    if (has_faces) {
      AddField("stretch",
               "change of edge lengths",
               "%",
               MeanEdgeStretch(parts_.source->points, *parts_.result, *parts_.triangles),
               source,
               ColorScale::kSigned);
    }
  }
  std::vector<double> deviations = parts_.std_dev;
  for (double& deviation : deviations) deviation = deviation >= 0.0 ? deviation : kNan;
  AddField("std_dev", "standard deviation (uncertainty)", kLength, deviations, source);
  if (!placed_.empty()) {
    AddField("bend",
             "displacement from the rigid placement",
             kLength,
             Lengths(placed_, *parts_.result),
             source);
  }
  if (parts_.source != nullptr) {
    AddField("displacement",
             "displacement from where it was given",
             kLength,
             Lengths(parts_.source->points, *parts_.result),
             source);
  }
}

void FitViewBuilder::AddSource() {
  PointCloud cloud;
  cloud.points = parts_.source != nullptr ? parts_.source->points : *parts_.result;
  if (parts_.triangles != nullptr) cloud.triangles = *parts_.triangles;
  std::vector<int> landmarks;
  for (const GivenLandmark& given : parts_.landmarks) landmarks.push_back(given.landmark.point);
  view_.scene.surfaces.push_back(
      MakeViewSurface("fitted source", cloud, parts_.rows, parts_.max_points, landmarks, &kept_));
  ViewSurface& source = view_.scene.surfaces.back();
  if (parts_.source != nullptr) AddMotion(&source);
  AddFields(&source);
}

void FitViewBuilder::AddTarget() {
  if (!has_target()) return;
  view_.scene.surfaces.push_back(
      MakeViewSurface("target", *parts_.target, {}, parts_.max_points, {}, &kept_));
  AddField("distance",
           "distance to the other surface",
           kLength,
           view_.distances.from_target,
           &view_.scene.surfaces.back());
}

void FitViewBuilder::AddGraph() {
  const ViewSurface& source = view_.scene.surfaces[0];
  if (parts_.warp == nullptr || !source.motion || source.motion->nodes.empty()) return;
  const DeformationGraph& graph = parts_.warp->graph;
  ViewGraph& shown = view_.scene.graph;
  for (int j = 0; j < graph.num_nodes(); ++j) {
    NodeKind kind = NodeKind::kUnknown;
    if (parts_.point_relevant != nullptr) {
      kind = (*parts_.point_relevant)[j] != 0 ? NodeKind::kPr : NodeKind::kPi;
    }
    if (j >= graph.num_surface_nodes()) kind = NodeKind::kInner;
    shown.kinds.push_back(kind);
  }
  for (const GraphEdge& edge : graph.edges()) {
    shown.edges.emplace_back(std::min(edge.from, edge.to), std::max(edge.from, edge.to));
  }
  std::sort(shown.edges.begin(), shown.edges.end());
  shown.edges.erase(std::unique(shown.edges.begin(), shown.edges.end()), shown.edges.end());
}

void FitViewBuilder::AddLandmarks() {
  for (const GivenLandmark& given : parts_.landmarks) {
    const auto at = std::lower_bound(kept_.begin(), kept_.end(), given.landmark.point);
    const double error = ((*parts_.result)[given.landmark.point] - given.landmark.position).norm();
    view_.scene.landmarks.push_back(
        {given.name, static_cast<int>(at - kept_.begin()), given.landmark.position, error});
  }
}

void FitViewBuilder::AddPanels() {
  std::vector<ViewPanel>& panels = view_.scene.panels;
  const bool moves = view_.scene.surfaces[0].motion.has_value();
  if (moves) panels.push_back({"Source", 0, 0.0, false, false});
  if (has_target()) panels.push_back({"Target", 1, 1.0, false});
  panels.push_back({"Result", 0, moves ? -1.0 : 1.0, true});
}

FitView FitViewBuilder::Build() {
  Place();
  Measure();
  AddSource();
  AddGraph();
  AddLandmarks();
  AddTarget();
  AddPanels();
  SetRanges(&view_.scene);
  for (const char* const key : {"truth", "distance", "displacement"}) {
    if (!view_.scene.first_field.empty()) break;
    if (view_.scene.surfaces[0].Find(key) != nullptr) view_.scene.first_field = key;
  }
  return std::move(view_);
}

}  // namespace

FitView MakeFitView(const FitParts& parts) { return FitViewBuilder(parts).Build(); }

std::vector<double> MeanEdgeStretch(const std::vector<Eigen::Vector3d>& before,
                                    const std::vector<Eigen::Vector3d>& after,
                                    const std::vector<std::array<int, 3>>& triangles) {
  std::vector<double> sums(before.size(), 0.0);
  std::vector<int> counts(before.size(), 0);
  for (const std::array<int, 3>& triangle : triangles) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangle[k];
      const int b = triangle[(k + 1) % 3];
      const double length = (before[a] - before[b]).norm();
      if (!(length > 0.0)) continue;
      constexpr double kPercent = 100.0;
      const double stretch = kPercent * ((after[a] - after[b]).norm() / length - 1.0);
      for (const int point : {a, b}) {
        sums[point] += stretch;
        ++counts[point];
      }
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sums[i] = counts[i] > 0 ? sums[i] / counts[i] : kNan;
  }
  return sums;
}

}  // namespace ceres_ed
