#include "ceres_ed/slam/tracker.h"

#include <ceres_ed/slam/frame/association.h>
#include <ceres_ed/slam/frame/relocalization.h>
#include <ceres_ed/util/timer.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace ceres_ed {
namespace {

// A pose that was found by a search replaces a tracked pose if its score is better by this factor,
// and if it explains this share of the points of the frame before.
constexpr double kClearlyBetter = 1.2;
constexpr double kLeastOfBefore = 0.4;
// The factor for a tracked pose that could be accepted and is where it was expected: within this
// distance of the prediction, in the coordinates of MotionInformation (map units).
constexpr double kMuchBetter = 2.0;
constexpr double kSmoothMotion = 2.0;
// The number of frames in which a pose that was found by a search has to explain what is seen
// before the map follows.
constexpr int kProvingFrames = 5;
// A tracked pose is right if at least this many corners were followed, and this share of them lies
// within this distance (map units) of the map.
constexpr int kFewestCorners = 20;
constexpr double kAgreeingCorners = 0.6;
constexpr double kCornerDistance = 0.5;
// The share of the corners that are searched for at a pose and must be found in their places, so
// that it is not chance.
constexpr double kRecognizedShare = 0.1;

// Returns the number of corners that lie where a pose and the map expect them.
int NumAgreeing(const std::vector<PointMatch>& matches, const CameraPose& camera_from_map) {
  const auto agrees = [&](const PointMatch& m) {
    return m.weight > 0.0 && (camera_from_map * m.in_map - m.in_camera).norm() < kCornerDistance;
  };
  return static_cast<int>(std::count_if(matches.begin(), matches.end(), agrees));
}

// Returns whether the corners confirm a pose.
bool CornersAgree(const std::vector<PointMatch>& matches, const CameraPose& camera_from_map) {
  const int count = NumAgreeing(matches, camera_from_map);
  return count >= kFewestCorners && count >= kAgreeingCorners * static_cast<double>(matches.size());
}

// A radius with which fewer patches than this share are left is too large for what is seen.
constexpr double kLeastSmoothed = 0.7;

// Patches farther away than this many times the median depth are not a part of the scene, but of
// its background, or errors.
constexpr double kFarthest = 4.0;

// Returns the area of the surface that a frame shows, in squares of the unit of the surface.
double VisibleArea(const ObservedSurface& surface) {
  double area = 0.0;
  const double farthest = kFarthest * surface.median_depth();
  for (int j = 0; j < surface.height(); ++j) {
    for (int i = 0; i < surface.width(); ++i) {
      const SurfacePatch& patch = surface.patch(i, j);
      if (!patch.valid() || patch.point.z() > farthest) continue;
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
      foreground_(camera),
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
  memory.corners = features_.HeapBytes();
  return memory;
}

FrameReport Tracker::Process(const SlamFrame& frame) {
  FrameReport report;
  report.number = frame.number;
  Timer timer;
  const bool first = unit_ == 0.0;
  if (first) Initialize(frame);
  if (unit_ == 0.0) return report;
  ObservedSurface surface = Smooth(frame, 1.0 / unit_, surface_radius_);
  report.times.observe = timer.Seconds();
  if (surface.num_valid() == 0) {
    gap_ = true;
    return report;
  }

  if (first) {
    report.status = FrameStatus::kInitialized;
    RemoveForeground(&surface, &report);
  } else if (FindCamera(frame, surface, &report)) {
    if (proving_ == 0) {
      RemoveForeground(&surface, &report);
      FollowTissue(surface, frame.catch_up, &report);
    } else {
      Measure(Associate(visible_, camera_from_map(), surface, AssociationOptions()),
              surface.noise(),
              &report);
    }
  }
  gap_ = report.status == FrameStatus::kLost;
  if (!gap_ && proving_ == 0) Grow(frame, surface, &report);
  report.nodes = map_.graph().num_nodes();
  report.map_points = map_.num_points();
  return report;
}

ObservedSurface Tracker::Smooth(const SlamFrame& frame, double scale, int radius) const {
  ObservedSurfaceOptions options = options_.surface;
  options.radius = radius;
  return {frame.depth, camera_, scale, options, frame.noise};
}

void Tracker::Initialize(const SlamFrame& frame) {
  const ObservedSurface rough = Smooth(frame, 1.0, options_.surface.radius);
  if (rough.num_valid() == 0) return;
  surface_radius_ = rough.RadiusForNoise();
  ObservedSurface surface = Smooth(frame, 1.0, surface_radius_);
  if (surface.num_valid() < kLeastSmoothed * rough.num_valid()) {
    surface_radius_ = options_.surface.radius;
    surface = rough;
  }
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

// Removes from the surface what stands before the tissue.
void Tracker::RemoveForeground(ObservedSurface* surface, FrameReport* report) {
  const Timer timer;
  report->foreground = foreground_.Remove(visible_, map_.state().camera_from_map, surface);
  report->times.associate += timer.Seconds();
}

// Nodes that come into view are brought up to date before they are used.
void Tracker::CatchUpInView(const CameraPose& camera_from_map, FrameReport* report) {
  const std::vector<int> near = map_.NodesNearView(ViewVolume(camera_from_map, camera_));
  report->updated_pi += levels_->CatchUp(near, /*priors=*/nullptr, &map_).variable_nodes;
}

bool Tracker::FindCamera(const SlamFrame& frame,
                         const ObservedSurface& surface,
                         FrameReport* report) {
  Timer timer;
  const CameraPose before = map_.state().camera_from_map;
  CameraPose predicted = Predict(frame);
  CatchUpInView(predicted, report);
  report->times.level2 += timer.Restart();
  visible_ = FindVisible(map_, predicted, camera_, VisibilityOptions());
  // A camera goes on as before, or stands still after a jump.
  if (options_.camera == CameraMode::kEstimate &&
      Misfit(visible_, before, surface) < Misfit(visible_, predicted, surface)) {
    predicted = before;
  }
  report->times.associate += timer.Restart();
  const bool color = options_.features && !frame.color.empty();
  std::vector<PointMatch> matches;
  bool continuous = true;
  if (color) {
    if (gap_) features_.Clear();
    continuous = features_.Track(frame.color, surface, map_, predicted);
    matches = features_.Matches(map_);
  }
  report->times.features += timer.Restart();
  report->status = FrameStatus::kTracked;
  if (options_.camera != CameraMode::kEstimate) {
    map_.SetCamera(predicted);
    return true;
  }
  CameraTrackerResult tracked =
      TrackCamera(visible_, matches, surface, predicted, CameraTrackerOptions());
  const bool anew = !continuous && features_.num_known() >= kFewestCorners;
  if (anew) FindCameraAnew(surface, &matches, &tracked, report);
  CameraPose found = tracked.camera_from_map;
  report->weak_directions = tracked.information.NumWeak();
  visible_ = FindVisible(map_, found, camera_, VisibilityOptions());
  const double moved = tracked.information.CoordinatesOf(found * predicted.Inverse()).norm();
  const bool smooth = moved < kSmoothMotion;
  const bool known = Confirm(surface, matches, before, smooth, &found, report);
  report->times.camera += timer.Restart();
  if (!known) {
    report->status = FrameStatus::kLost;
    camera_step_ = CameraPose();
    visible_.clear();
    return false;
  }
  // The camera has jumped, and was found by a search.
  if (anew && !smooth) report->status = FrameStatus::kRelocalized;
  camera_step_ = report->status == FrameStatus::kRelocalized
                     ? CameraPose()
                     : tracked.information.DeterminedPart(found * before.Inverse());
  map_.SetCamera(found);
  return true;
}

// Refines a pose, and searches for the corners that it brings into view. Returns how much speaks
// for the pose: the number of corners in their places, or 0 if these are so few that they may be
// there by chance.
int Tracker::FindCorners(const ObservedSurface& surface,
                         const CameraPose& start,
                         std::vector<PointMatch>* matches,
                         CameraTrackerResult* tracked,
                         FrameReport* report) {
  CatchUpInView(start, report);
  visible_ = FindVisible(map_, start, camera_, VisibilityOptions());
  features_.Clear();
  const int searched = features_.Recall(surface, map_, start);
  *matches = features_.Matches(map_);
  *tracked = TrackCamera(visible_, *matches, surface, start, CameraTrackerOptions());
  const int found = NumAgreeing(*matches, tracked->camera_from_map);
  return found >= kFewestCorners && found >= kRecognizedShare * searched ? found : 0;
}

// Finds the camera when the corners are not where they were expected, as after a gap or a jump:
// from the pose that the depth tells, from the one at which corners are recognised by their
// descriptors, and, if neither is confirmed by corners, from a search by the depth alone. If
// corners confirm none of them, there are no matches, and the pose is that of the depth.
void Tracker::FindCameraAnew(const ObservedSurface& surface,
                             std::vector<PointMatch>* matches,
                             CameraTrackerResult* tracked,
                             FrameReport* report) {
  const CameraTrackerResult by_depth = *tracked;
  std::vector<CameraPose> starts = {by_depth.camera_from_map};
  if (const auto place = features_.Recognize(surface, map_)) starts.push_back(*place);
  int best = 0;
  CameraPose best_start;
  const auto attempt = [&](const CameraPose& start) {
    const int found = FindCorners(surface, start, matches, tracked, report);
    if (found <= best) return;
    best = found;
    best_start = start;
  };
  for (const CameraPose& start : starts) attempt(start);
  if (best == 0) {
    PoseQualityOptions judge;
    judge.point_spacing = options_.growth.point_spacing;
    attempt(Relocalize(map_, surface, map_.state().camera_from_map, VisibilityOptions(), judge)
                .camera_from_map);
  }
  if (best > 0) {
    FindCorners(surface, best_start, matches, tracked, report);
    return;
  }
  *tracked = by_depth;
  matches->clear();
  features_.Clear();
}

// Decides whether a tracked pose is right. One that explains the frame badly is compared with a
// pose that is found by a search, which is preferred more easily if the tracked one is not where it
// was expected (`smooth`). Returns false if neither can be accepted. A pose that was found
// by a search has to prove itself: at once by corners that are recognised, or by several frames
// that it explains well.
bool Tracker::Confirm(const ObservedSurface& surface,
                      const std::vector<PointMatch>& matches,
                      const CameraPose& before,
                      bool smooth,
                      CameraPose* pose,
                      FrameReport* report) {
  PoseQualityOptions judge;
  judge.point_spacing = options_.growth.point_spacing;
  if (CornersAgree(matches, *pose)) {
    proving_ = 0;
    return true;
  }
  // Depth may drop out, and a tool may come before the tissue, but not while the camera jumps.
  judge.trust_gaps = smooth;
  const PoseQuality quality = JudgePose(visible_, *pose, surface, judge);
  if (!judge.Doubts(quality)) {
    proving_ = std::max(0, proving_ - 1);
    return true;
  }
  judge.trust_gaps = false;
  const Relocalization other = Relocalize(map_, surface, before, VisibilityOptions(), judge);
  // A flat piece of tissue fits in many places. A pose that was found by a search must therefore be
  // good in every respect, and must explain about as much of the map as was seen before.
  const bool sound =
      !judge.Doubts(other.quality) && other.quality.points >= kLeastOfBefore * points_before_;
  const bool believed = judge.Believes(quality);
  const double better = believed && smooth ? kMuchBetter : kClearlyBetter;
  if (!sound || other.quality.Score() <= better * quality.Score()) {
    return believed && proving_ == 0;
  }
  *pose = other.camera_from_map;
  report->status = FrameStatus::kRelocalized;
  CatchUpInView(*pose, report);
  visible_ = FindVisible(map_, *pose, camera_, VisibilityOptions());
  features_.Clear();
  features_.Recall(surface, map_, *pose);
  proving_ = CornersAgree(features_.Matches(map_), *pose) ? 0 : kProvingFrames;
  return true;
}

}  // namespace ceres_ed
