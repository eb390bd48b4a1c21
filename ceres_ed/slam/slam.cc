#include "ceres_ed/slam/slam.h"

#include <ceres_ed/slam/relocalization.h>
#include <ceres_ed/util/option_check.h>
#include <ceres_ed/util/timer.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ceres_ed {
namespace {

// A pose found from scratch replaces a tracked one whose score it beats by this factor.
constexpr double kClearlyBetter = 1.2;
constexpr double kLeastOfBefore = 0.4;

CameraPose Compose(const CameraPose& a, const CameraPose& b) {
  return {(a.rotation * b.rotation).normalized(), a.rotation * b.translation + a.translation};
}

CameraPose Inverse(const CameraPose& pose) {
  const Eigen::Quaterniond back = pose.rotation.conjugate();
  return {back, -(back * pose.translation)};
}

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

std::string FrameStatusName(FrameStatus status) {
  switch (status) {
    case FrameStatus::kTracked:
      return "tracked";
    case FrameStatus::kInitialized:
      return "initialized";
    case FrameStatus::kRelocalized:
      return "relocalized";
    case FrameStatus::kLost:
      return "lost";
    case FrameStatus::kSkipped:
      return "skipped";
  }
  return "skipped";
}

bool SlamOptions::IsValid(std::string* error) const {
  const auto require = [error](bool holds, const char* option, double value, const char* expected) {
    return RequireOption(holds, option, value, expected, error);
  };
  return require(rings >= 0, "rings", rings, ">= 0") &&
         require(node_spacing >= 0.0 && std::isfinite(node_spacing),
                 "node_spacing",
                 node_spacing,
                 "metres >= 0") &&
         require(nodes_in_view >= 4, "nodes_in_view", nodes_in_view, ">= 4") &&
         require(neighbors >= 1 && neighbors <= kMaxBoundNodes, "neighbors", neighbors, "1 to 8") &&
         require(rounds >= 1, "rounds", rounds, ">= 1") &&
         require(max_observations >= 100, "max_observations", max_observations, ">= 100") &&
         require(max_point_weight >= 1.0, "max_point_weight", max_point_weight, ">= 1") &&
         require(verify_every >= 0, "verify_every", verify_every, ">= 0") &&
         require(num_threads >= 1, "num_threads", num_threads, ">= 1") &&
         require(surface.cell >= 1, "surface.cell", surface.cell, ">= 1") &&
         require(surface.radius >= 1, "surface.radius", surface.radius, ">= 1") &&
         require(growth.point_spacing > 0.0, "growth.point_spacing", growth.point_spacing, "> 0") &&
         require(growth.node_coverage > 0.0, "growth.node_coverage", growth.node_coverage, "> 0") &&
         require(feature.count >= 0, "feature.count", feature.count, ">= 0") &&
         levels.lazy.IsValid(error) && levels.solver.IsValid(error);
}

DeformableSlam::DeformableSlam(const PinholeCamera& camera, const SlamOptions& options)
    : camera_(camera),
      options_(options),
      map_(options.neighbors),
      features_(options.feature),
      memory_(options.memory) {}

StatusOr<std::unique_ptr<DeformableSlam>> DeformableSlam::Create(const PinholeCamera& camera,
                                                                 const SlamOptions& options,
                                                                 const EnergyRegistry& registry) {
  std::string error;
  if (!camera.IsValid(&error)) return Status::Error("camera: " + error);
  if (!options.IsValid(&error)) return Status::Error(error);
  std::unique_ptr<DeformableSlam> slam(new DeformableSlam(camera, options));
  LevelsOptions levels = options.levels;
  levels.rings = options.mode == SolveMode::kBatch ? -1 : options.rings;
  levels.seam_edges = options.seam_edges;
  levels.marginal = options.mode == SolveMode::kMarginal;
  levels.camera_variable = options.camera == CameraMode::kEstimate;
  levels.solver.num_threads = options.num_threads;
  StatusOr<std::unique_ptr<Levels>> created = Levels::Create(levels, registry);
  if (!created.ok()) return created.status();
  slam->levels_ = *std::move(created);
  if (options.verify_every > 0) {
    StatusOr<std::unique_ptr<BatchReference>> batch = BatchReference::Create(levels, registry);
    if (!batch.ok()) return batch.status();
    slam->batch_ = *std::move(batch);
  }
  return slam;
}

MapMemory DeformableSlam::Memory() const {
  MapMemory memory;
  map_.AddMemory(&memory);
  memory.tissue_memory = memory_.HeapBytes();
  memory.levels = levels_->HeapBytes();
  return memory;
}

FrameReport DeformableSlam::Process(const SlamFrame& frame) {
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

void DeformableSlam::Initialize(const SlamFrame& frame) {
  const ObservedSurface surface(frame.depth, camera_, 1.0, options_.surface);
  if (surface.num_valid() == 0) return;
  // Nodes one spacing apart on a plane: each stands for 0.87 of a square of that side.
  unit_ = options_.node_spacing > 0.0
              ? options_.node_spacing
              : std::sqrt(VisibleArea(surface) / (0.87 * options_.nodes_in_view));
  if (frame.world_from_camera != nullptr) world_from_map_ = *frame.world_from_camera;
}

CameraPose DeformableSlam::Predict(const SlamFrame& frame) const {
  const CameraPose& before = map_.state().camera_from_map;
  switch (options_.camera) {
    case CameraMode::kEstimate:
      return Compose(camera_step_, before);
    case CameraMode::kFixed:
      return before;
    case CameraMode::kGiven:
      break;
  }
  if (frame.world_from_camera == nullptr) return before;
  CameraPose pose = Compose(Inverse(*frame.world_from_camera), world_from_map_);
  pose.translation /= unit_;
  return pose;
}

// What comes into view is brought up to date ahead of that.
int DeformableSlam::CatchUpInView(const CameraPose& camera_from_map) {
  const std::vector<int> near = map_.NodesNearView(ViewVolume(camera_from_map, camera_));
  return levels_->CatchUp(near, /*priors=*/nullptr, &map_).variable_nodes;
}

bool DeformableSlam::FindCamera(const SlamFrame& frame,
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
  camera_step_ = jumped ? CameraPose() : Compose(found, Inverse(before));
  map_.SetCamera(found);
  return true;
}

// A tracked pose that explains the frame badly is held against one that is looked for from scratch.
// False when neither is to be believed.
bool DeformableSlam::Confirm(const ObservedSurface& surface,
                             const CameraPose& before,
                             CameraPose* pose,
                             FrameReport* report) {
  PoseQualityOptions judge;
  judge.point_spacing = options_.growth.point_spacing;
  PoseQuality quality = JudgePose(visible_, *pose, surface, judge);
  if (!judge.Doubts(quality)) return true;
  const Relocalization other = Relocalize(map_, surface, before, VisibilityOptions(), judge);
  // A flat piece of anything fits somewhere: what is found from scratch must show no weakness, and
  // about as much of the map as was seen before.
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
