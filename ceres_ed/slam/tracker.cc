#include "ceres_ed/slam/tracker.h"

#include <ceres_ed/slam/frame/relocalization.h>
#include <ceres_ed/util/timer.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ceres_ed {
namespace {

// A pose that was found by a search replaces a tracked pose if its score is better by this factor,
// and if it explains this share of the points of the frame before.
constexpr double kClearlyBetter = 1.2;
constexpr double kLeastOfBefore = 0.4;

double VisibleArea(const ObservedSurface& surface) {
  double area = 0.0;
  for (int j = 0; j < surface.height(); ++j) {
    for (int i = 0; i < surface.width(); ++i) {
      const SurfacePatch& patch = surface.patch(i, j);
      if (!patch.valid()) continue;
      const double cosine = -patch.normal.dot(patch.point) / patch.point.norm();
      const double side = surface.cell() * patch.point.z();
      area += side * side / (surface.camera().fx * surface.camera().fy) / std::max(cosine, 0.2);
    }
  }
  return area;
}

}  // namespace

SlamOptions WithSharedSettings(SlamOptions options) {
  options.surface.num_threads = options.num_threads;
  options.feature.pixels.num_threads = options.num_threads;
  options.levels.solver.num_threads = options.num_threads;
  options.levels.camera_variable = options.camera == CameraMode::kEstimate;
  return options;
}

Tracker::Tracker(const PinholeCamera& camera, const SlamOptions& options)
    : camera_(camera),
      options_(WithSharedSettings(options)),
      map_(options_.neighbors),
      features_(options_.feature),
      memory_(options_.memory) {}

Status Tracker::AddLevels(const EnergyRegistry& registry) {
  StatusOr<std::unique_ptr<Levels>> created = Levels::Create(options_.levels, registry);
  if (!created.ok()) return created.status();
  levels_ = *std::move(created);
  if (options_.verify_every > 0) {
    StatusOr<std::unique_ptr<BatchReference>> batch =
        BatchReference::Create(options_.levels, registry);
    if (!batch.ok()) return batch.status();
    batch_ = *std::move(batch);
  }
  return Status::Ok();
}

MapMemory Tracker::Memory() const {
  MapMemory memory;
  map_.AddMemory(&memory);
  memory.tissue_memory = memory_.HeapBytes();
  memory.levels = levels_->HeapBytes();
  return memory;
}

FrameReport Tracker::Process(const SlamFrame& frame) {
  FrameReport report;
  report.number = frame.number;
  Timer timer;
  const bool first = unit_ == 0.0;
  if (first) Initialize(frame);
  if (unit_ == 0.0) return report;
  const ObservedSurface surface(frame.depth, camera_, 1.0 / unit_, options_.surface);
  report.times.observe = timer.Seconds();
  if (surface.num_valid() == 0) return report;

  if (first) {
    report.status = FrameStatus::kInitialized;
  } else if (FindCamera(frame, surface, &report)) {
    FollowTissue(surface, frame.catch_up, &report);
  } else {
    report.nodes = map_.graph().num_nodes();
    report.map_points = map_.num_points();
    return report;
  }
  Grow(frame, surface, &report);
  report.nodes = map_.graph().num_nodes();
  report.map_points = map_.num_points();
  return report;
}

void Tracker::Initialize(const SlamFrame& frame) {
  const ObservedSurface surface(frame.depth, camera_, 1.0, options_.surface);
  if (surface.num_valid() == 0) return;
  // The unit is one node spacing: on a plane each node has an area of 0.87 square spacings.
  unit_ = options_.node_spacing > 0.0
              ? options_.node_spacing
              : std::sqrt(VisibleArea(surface) / (0.87 * options_.nodes_in_view));
  if (frame.world_from_camera != nullptr) world_from_map_ = *frame.world_from_camera;
}

CameraPose Tracker::Predict(const SlamFrame& frame) const {
  const CameraPose& before = map_.state().camera_from_map;
  switch (options_.camera) {
    case CameraMode::kEstimate:
      return camera_step_ * before;
    case CameraMode::kFixed:
      return before;
    case CameraMode::kGiven:
      break;
  }
  if (frame.world_from_camera == nullptr) return before;
  CameraPose pose = frame.world_from_camera->Inverse() * world_from_map_;
  pose.translation /= unit_;
  return pose;
}

// Nodes that come into view are brought up to date before they are used.
int Tracker::CatchUpInView(const CameraPose& camera_from_map) {
  const std::vector<int> near = map_.NodesNearView(ViewVolume(camera_from_map, camera_));
  return levels_->CatchUp(near, /*priors=*/nullptr, &map_).variable_nodes;
}

bool Tracker::FindCamera(const SlamFrame& frame,
                         const ObservedSurface& surface,
                         FrameReport* report) {
  Timer timer;
  const CameraPose before = map_.state().camera_from_map;
  const CameraPose predicted = Predict(frame);
  const bool color = options_.features && !frame.color.empty();
  std::vector<PointMatch> matches;
  if (color) {
    features_.Track(frame.color, surface, map_, predicted);
    matches = features_.Matches(map_);
  }
  report->times.features += timer.Restart();
  report->updated_pi += CatchUpInView(predicted);
  report->times.level2 += timer.Restart();
  const VisibilityOptions visibility;
  visible_ = FindVisible(map_, predicted, camera_, visibility);
  report->times.associate += timer.Restart();
  CameraPose found = predicted;
  report->status = FrameStatus::kTracked;
  if (options_.camera == CameraMode::kEstimate) {
    found =
        TrackCamera(visible_, matches, surface, predicted, CameraTrackerOptions()).camera_from_map;
    visible_ = FindVisible(map_, found, camera_, visibility);
    if (!Confirm(surface, before, &found, report)) {
      report->status = FrameStatus::kLost;
      camera_step_ = CameraPose();
      visible_.clear();
      report->times.camera += timer.Restart();
      return false;
    }
  }
  report->times.camera += timer.Restart();
  const bool jumped = report->status == FrameStatus::kRelocalized;
  camera_step_ = jumped ? CameraPose() : found * before.Inverse();
  map_.SetCamera(found);
  return true;
}

// Compares a tracked pose that explains the frame badly with a pose that is found by a search.
// Returns false if neither can be accepted.
bool Tracker::Confirm(const ObservedSurface& surface,
                      const CameraPose& before,
                      CameraPose* pose,
                      FrameReport* report) {
  PoseQualityOptions judge;
  judge.point_spacing = options_.growth.point_spacing;
  PoseQuality quality = JudgePose(visible_, *pose, surface, judge);
  if (!judge.Doubts(quality)) return true;
  const Relocalization other = Relocalize(map_, surface, before, VisibilityOptions(), judge);
  // A flat piece of tissue fits in many places. A pose that was found by a search must therefore be
  // good in every respect, and must explain about as much of the map as was seen before.
  const bool sound =
      !judge.Doubts(other.quality) && other.quality.points >= kLeastOfBefore * points_before_;
  if (sound && other.quality.Score() > kClearlyBetter * quality.Score()) {
    *pose = other.camera_from_map;
    report->status = FrameStatus::kRelocalized;
    report->updated_pi += CatchUpInView(*pose);
    visible_ = FindVisible(map_, *pose, camera_, VisibilityOptions());
    features_.Clear();
    return true;
  }
  return judge.Believes(quality);
}

}  // namespace ceres_ed
