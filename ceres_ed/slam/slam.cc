#include "ceres_ed/slam/slam.h"

#include <ceres_ed/slam/relocalization.h>
#include <ceres_ed/util/timer.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>

namespace ceres_ed {
namespace {

constexpr double kInlierWidth = 3.0;
// A frame is done when a round takes less than this share off the energy.
constexpr int kLeastRounds = 2;
constexpr double kSmallGain = 0.1;
// A pose found from scratch replaces a tracked one whose score it beats by this factor.
constexpr double kClearlyBetter = 1.2;
constexpr double kLeastOfBefore = 0.4;

CameraPose Compose(const CameraPose& a, const CameraPose& b) {
  CameraPose pose;
  pose.rotation = (a.rotation * b.rotation).normalized();
  pose.translation = a.rotation * b.translation + a.translation;
  return pose;
}

CameraPose Inverse(const CameraPose& pose) {
  CameraPose inverse;
  inverse.rotation = pose.rotation.conjugate();
  inverse.translation = -(inverse.rotation * pose.translation);
  return inverse;
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
  std::unique_ptr<DeformableSlam> slam(new DeformableSlam(camera, options));
  LevelsOptions levels = options.levels;
  levels.rings = options.mode == SolveMode::kBatch ? -1 : options.rings;
  levels.seam_edges = options.seam_edges;
  levels.camera_variable = options.camera == CameraMode::kEstimate;
  levels.solver.num_threads = options.num_threads;
  StatusOr<std::unique_ptr<Levels>> created = Levels::Create(levels, registry);
  if (!created.ok()) return created.status();
  slam->levels_ = *std::move(created);
  return slam;
}

FrameReport DeformableSlam::Process(const SlamFrame& frame) {
  FrameReport report;
  report.number = frame.number;
  Timer timer;
  const bool first = unit_ == 0.0;
  if (first) Initialize(frame);
  if (unit_ == 0.0) return report;
  const ObservedSurface surface(*frame.depth, camera_, 1.0 / unit_, options_.surface);
  report.times.observe = timer.Seconds();
  if (surface.num_valid() == 0) return report;

  if (first) {
    report.status = FrameStatus::kInitialized;
  } else if (FindCamera(frame, surface, &report)) {
    FollowTissue(surface, &report);
    Fuse(surface);
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
  const ObservedSurface surface(*frame.depth, camera_, 1.0, options_.surface);
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

bool DeformableSlam::FindCamera(const SlamFrame& frame,
                                const ObservedSurface& surface,
                                FrameReport* report) {
  Timer timer;
  const CameraPose before = map_.state().camera_from_map;
  const CameraPose predicted = Predict(frame);
  const bool color = options_.features && frame.color != nullptr && !frame.color->empty();
  std::vector<PointMatch> matches;
  if (color) {
    features_.Track(*frame.color, surface, map_, predicted);
    matches = features_.Matches(map_);
  }
  report->times.features += timer.Restart();
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
  map_.mutable_state().camera_from_map = found;
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
    visible_ = FindVisible(map_, *pose, camera_, VisibilityOptions());
    features_.Clear();
    return true;
  }
  return judge.Believes(quality);
}

FrameObservations DeformableSlam::Observe(const AssociationResult& association) const {
  FrameObservations observations;
  const std::size_t count = association.matches.size();
  const std::size_t kept = std::min<std::size_t>(count, options_.max_observations);
  for (std::size_t k = 0; k < kept; ++k) {
    const Association& match = association.matches[k * count / kept];
    const VisiblePoint& point = visible_[match.visible];
    MapObservation o;
    o.position = map_.point(point.slot).position;
    o.binding = map_.binding(point.slot);
    o.target = match.patch->point;
    o.normal = match.patch->normal;
    o.weight = match.weight;
    observations.planes.push_back(o);
  }
  return observations;
}

void DeformableSlam::FollowTissue(const ObservedSurface& surface, FrameReport* report) {
  Timer timer;
  const double noise = std::max(surface.noise(), 1e-4);
  map_.SetNodePrior(memory_.Recall(map_, levels_->point_relevant()));
  for (int round = 0; round < options_.rounds; ++round) {
    const CameraPose& pose = map_.state().camera_from_map;
    const AssociationResult association = Associate(visible_, pose, surface, AssociationOptions());
    FrameObservations observations = Observe(association);
    observations.plane_width = 5.0 * std::max(association.deviation, noise);
    observations.features = features_.Observations();
    std::vector<double> distances;
    for (const PointMatch& m : features_.Matches(map_)) {
      distances.push_back((pose * m.in_map - m.in_camera).norm());
    }
    observations.feature_width = 5.0 * std::max(MedianDeviation(distances), noise);
    report->times.associate += timer.Restart();
    const LevelReport level = levels_->SolveLevelOne(observations, &map_);
    report->point_relevant = level.point_relevant;
    report->active = level.variable_nodes;
    report->energy = level.energy;
    report->iterations += level.iterations;
    report->times.level1 += timer.Restart();
    UpdateVisible(map_, map_.state().camera_from_map, camera_, &visible_);
    report->times.warp += timer.Restart();
    const double gain = level.initial_energy - level.energy;
    if (round + 1 >= kLeastRounds && gain < kSmallGain * level.initial_energy) break;
  }
  if (options_.mode != SolveMode::kBatch) {
    map_.SetNodePrior(memory_.Recall(map_, levels_->point_relevant()));
    const LevelReport level = levels_->SolveLevelTwo(&map_);
    report->updated_pi = level.variable_nodes;
    report->times.level2 += timer.Restart();
    UpdateVisible(map_, map_.state().camera_from_map, camera_, &visible_);
    report->times.warp += timer.Restart();
  }
  memory_.Keep(map_, levels_->point_relevant());
  features_.DropOutliers(map_, noise);
  const AssociationResult association =
      Associate(visible_, map_.state().camera_from_map, surface, AssociationOptions());
  double squares = 0.0;
  for (const Association& m : association.matches) {
    if (std::abs(m.distance) > kInlierWidth * std::max(association.deviation, noise)) continue;
    ++report->inliers;
    squares += m.distance * m.distance;
  }
  report->points = static_cast<int>(association.matches.size());
  points_before_ = report->points;
  report->rms_plane = std::sqrt(squares / std::max(1, report->inliers)) * unit_;
  report->features = features_.size();
  report->times.associate += timer.Restart();
}

void DeformableSlam::Fuse(const ObservedSurface& surface) {
  const CameraPose& pose = map_.state().camera_from_map;
  const AssociationResult association = Associate(visible_, pose, surface, AssociationOptions());
  const double width = kInlierWidth * std::max(association.deviation, surface.noise());
  for (const Association& m : association.matches) {
    if (std::abs(m.distance) > width) continue;
    const int slot = visible_[m.visible].slot;
    MapPoint& point = map_.mutable_point(slot);
    const LocalWarp warp = map_.WarpOf(map_.binding(slot));
    const double share = m.weight / (point.weight + m.weight);
    // Along the normal alone: back-projection knows nothing of where along the surface.
    const Eigen::Vector3d correction = pose.rotation.conjugate() * (-m.distance * m.patch->normal);
    point.position += share * (warp.gradient.inverse() * correction);
    const Eigen::Vector3d normal =
        warp.gradient.transpose() * (pose.rotation.conjugate() * m.patch->normal);
    point.normal = ((1.0 - share) * point.normal + share * normal.normalized()).normalized();
    point.weight = std::min(point.weight + m.weight, options_.max_point_weight);
    point.contradictions = std::max(0, point.contradictions - 1);
  }
  for (const int i : association.seen_through) {
    if (++map_.mutable_point(visible_[i].slot).contradictions < 5) continue;
    map_.RemovePoint(visible_[i].slot);
    visible_[i].slot = -1;
  }
  const auto gone = [](const VisiblePoint& point) { return point.slot < 0; };
  visible_.erase(std::remove_if(visible_.begin(), visible_.end(), gone), visible_.end());
}

void DeformableSlam::Grow(const SlamFrame& frame,
                          const ObservedSurface& surface,
                          FrameReport* report) {
  Timer timer;
  static const ColorImage kNoColor;
  const bool color = frame.color != nullptr && !frame.color->empty();
  GrowMap(visible_, surface, color ? *frame.color : kNoColor, frame.number, options_.growth, &map_);
  report->times.grow += timer.Restart();
  if (!color || !options_.features) return;
  if (report->status == FrameStatus::kInitialized) {
    features_.Track(*frame.color, surface, map_, map_.state().camera_from_map);
  }
  features_.Replenish(surface, map_);
  report->times.features += timer.Restart();
}

}  // namespace ceres_ed
