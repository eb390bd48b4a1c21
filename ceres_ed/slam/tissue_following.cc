// The changes of the map in a frame after the camera has been found: Level I and II, fusion,
// growth.
#include <ceres_ed/slam/frame/association.h>
#include <ceres_ed/slam/frame/still_tissue.h>
#include <ceres_ed/slam/levels/edge_weights.h>
#include <ceres_ed/slam/levels/level_covariance.h>
#include <ceres_ed/slam/tracker.h>
#include <ceres_ed/util/statistics.h>
#include <ceres_ed/util/timer.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/LU>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {
namespace {

// Widths in deviations: of inliers, and of the losses.
constexpr double kInlierWidth = 3.0;
constexpr double kLossWidth = 5.0;
// The least deviation of inliers, in map units. Where depth is exact the spread of all distances is
// that of what stands still, and points on what moves would be taken for outliers and dropped.
constexpr double kLeastInlierDeviation = 0.02;
// The smallest noise, in map units; no sensor is better than this.
constexpr double kLeastNoise = 1e-4;
// The least widths of the losses, and the least deviation of corners, in map units. The spread of
// all residuals is that of what stands still; a width from this alone would leave behind what moves
// elsewhere.
constexpr double kLeastLossWidth = 1.0;
constexpr double kLeastFeatureDeviation = 0.2;
// The motion of the tissue in a frame for which the weight of the node prior is meant, in map
// units.
constexpr double kUsualMotion = 0.1;
// A frame ends when a round reduces the energy by less than this share.
constexpr int kLeastRounds = 2;
constexpr double kSmallGain = 0.1;
// The tissue keeps still if the residuals of the rigid alignment vary from node to node at most by
// this factor more than noise, and if neighbouring corners agree about a motion at most so far, or
// by chance (in deviations). The noise of planes is at least this (map units), which is the error
// that the smoothing of curved surfaces leaves. Corners are neighbours up to this distance.
constexpr double kStillSpread = 2.0;
constexpr double kStillCoherence = 0.1;
constexpr double kStillChance = 2.0;
constexpr double kStillDeviation = 0.005;
constexpr double kStillReach = 2.0;
// Residuals are limited to this many deviations, so that outliers do not count as motion.
constexpr double kStillLimit = 5.0;

}  // namespace

FrameObservations Tracker::Observe(const AssociationResult& association) const {
  FrameObservations observations;
  // The built-in energies do not use these details.
  const bool with_details = !options_.levels.energies.empty();
  const CameraPose& pose = map_.state().camera_from_map;
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
    if (with_details) o.source_normal = pose.rotation * point.normal_in_map;
    o.weight = match.weight;
    observations.planes.push_back(o);
  }
  return observations;
}

double Tracker::FeatureDeviation() const {
  const CameraPose& pose = map_.state().camera_from_map;
  std::vector<double> distances;
  for (const PointMatch& m : features_.Matches(map_)) {
    distances.push_back((pose * m.in_map - m.in_camera).norm());
  }
  return RobustDeviation(std::move(distances));
}

// Returns by how much less than usual the nodes are held where they were: the prior is that of a
// random walk, whose variance is the square of how far the tissue moves in a frame. What the rigid
// alignment leaves of the corners' motion tells how far that is, for example if frames are missing.
double Tracker::NodePriorShare() const {
  const double motion = FeatureDeviation();
  return motion > kUsualMotion ? kUsualMotion * kUsualMotion / (motion * motion) : 1.0;
}

// Decides whether the deformation of the map explains the frame already, so that Level I would only
// follow the noise, and would exchange motion with the camera. The map is compared as it is, so
// that slow motion adds up until it is seen.
bool Tracker::IsTissueStill(const AssociationResult& association,
                            const ObservedSurface& surface) const {
  // Only they know where users' energies pull.
  if (!options_.levels.energies.empty()) return false;
  const double limit = kStillLimit * association.deviation;
  std::vector<NodeResidual> residuals;
  residuals.reserve(association.matches.size());
  for (const Association& m : association.matches) {
    const PointBinding binding = map_.binding(visible_[m.visible].slot);
    const auto nearest = std::max_element(binding.weights, binding.weights + binding.size);
    residuals.push_back(
        {binding.nodes[nearest - binding.weights], std::clamp(m.ScaledDistance(), -limit, limit)});
  }
  // Points that are nearer to each other than the windows of their patches have errors in common.
  const double window_side = (2.0 * surface_radius_ + 1.0) / surface.cell();
  const double points_per_window =
      window_side * window_side * static_cast<double>(residuals.size()) / surface.num_valid();
  if (SpreadBetweenNodes(std::move(residuals), points_per_window, kStillDeviation) > kStillSpread) {
    return false;
  }
  const Coherence coherence =
      CornerCoherence(features_.Matches(map_), map_.state().camera_from_map, kStillReach);
  return coherence.value <= std::max(kStillCoherence, kStillChance * coherence.deviation);
}

// Nodes whose recalled positions have changed must move, so they become unsettled.
void Tracker::NoteRecalled() {
  const std::vector<int> affected = memory_.Affected();
  std::vector<Eigen::Vector3d> before;
  before.reserve(affected.size());
  for (const int node : affected) before.push_back(map_.node_prior(node));
  memory_.UpdatePriors(affected, &map_);
  PendingNodes& pending = levels_->pending();
  for (std::size_t k = 0; k < affected.size(); ++k) {
    const double change = (map_.node_prior(affected[k]) - before[k]).norm();
    if (change > pending.tolerance()) {
      pending.Raise(affected[k], change);
    } else {
      // Small changes accumulate until they are large enough.
      map_.SetNodePrior(affected[k], before[k]);
    }
  }
}

// The nodes that were added in the last frame and not seen since become unsettled, and so do their
// neighbours.
void Tracker::NoteNewNodes() {
  PendingNodes& pending = levels_->pending();
  const double change = 2.0 * pending.tolerance();
  for (int node = nodes_before_growth_; node < map_.graph().num_nodes(); ++node) {
    if (levels_->moved_nodes().Has(node)) continue;
    pending.Raise(node, change);
    for (const int e : map_.graph().incident_edges(node)) {
      const GraphEdge& edge = map_.graph().edges()[e];
      if (edge.from == node && !levels_->moved_nodes().Has(edge.to)) pending.Raise(edge.to, change);
    }
  }
}

// Level I in rounds, each with a new association. Returns the observations of the last round.
FrameObservations Tracker::FollowSeen(const ObservedSurface& surface, FrameReport* report) {
  Timer timer;
  const CameraPose& pose = map_.state().camera_from_map;
  const double noise = std::max(surface.noise(), kLeastNoise);
  FrameObservations observations;
  const auto take = [&](const LevelReport& level) {
    report->point_relevant = level.point_relevant;
    report->active = level.variable_nodes - level.marginalized;
    report->marginalized = level.marginalized;
    report->energy = level.energy;
    report->held_share = level.held_share;
    report->iterations += level.iterations;
    report->times.level1 += timer.Restart();
  };
  // The rigid alignment of the frame is what is known of the camera beside the data.
  observations.camera_prior = pose;
  for (int round = 0; round < options_.rounds; ++round) {
    const AssociationResult association = Associate(visible_, pose, surface, AssociationOptions());
    const CameraPose prior = observations.camera_prior;
    const double share = round == 0 ? NodePriorShare() : observations.node_prior_share;
    observations = Observe(association);
    observations.camera_prior = prior;
    observations.node_prior_share = share;
    observations.plane_width =
        std::max(kLossWidth * std::max(association.deviation, noise), kLeastLossWidth);
    observations.features = features_.Observations();
    observations.feature_width =
        std::max(kLossWidth * std::max(FeatureDeviation(), noise), kLeastLossWidth);
    // One frame alone may look still by chance, for example at the end of a breath.
    bool hold = false;
    if (round == 0) {
      const bool still = IsTissueStill(association, surface);
      hold = still && was_still_;
      was_still_ = still;
    }
    report->times.associate += timer.Restart();
    if (hold) {
      levels_->HoldLevelOne(observations, map_);
      memory_.Look(levels_->point_relevant(), map_);
      report->point_relevant = levels_->point_relevant().size();
      return observations;
    }
    memory_.Look(levels_->point_relevant(), map_);
    const LevelReport level = levels_->SolveLevelOne(observations, &memory_, &map_);
    take(level);
    UpdateVisible(map_, pose, camera_, &visible_);
    report->times.warp += timer.Restart();
    const double gain = level.initial_energy - level.energy;
    if (round + 1 >= kLeastRounds && gain < kSmallGain * level.initial_energy) break;
  }
  if (levels_->Eliminates()) {
    take(levels_->ConvergeLevelOne(observations, &memory_, &map_));
  }
  return observations;
}

// A frame whose covariances cannot be computed has none; its result is as good as without.
void Tracker::MeasureCovariances(const FrameObservations& observations, FrameReport* report) {
  std::vector<int> slots;
  slots.reserve(visible_.size());
  for (const VisiblePoint& point : visible_) slots.push_back(point.slot);
  const StatusOr<std::unique_ptr<LevelCovariance>> level =
      levels_->MeasureLevelOne(observations, slots, map_);
  if (!level.ok()) return;
  LevelCovariance::Matrix6d camera = (*level)->MapFromCamera();
  // A camera that was given is certain.
  if (!camera.isZero(0.0))
    camera += CommonMotionCovariance(observations, nodes_before_, map_.state());
  if (camera.allFinite()) {
    camera.topRows<3>() *= unit_;
    camera.leftCols<3>() *= unit_;
    report->camera_covariance = camera;
  }
  for (const VisiblePoint& point : visible_) {
    const MapPoint there = map_.point(point.slot);
    const Eigen::Matrix3d covariance = (*level)->Point(there.position, map_.binding(point.slot));
    if (covariance.allFinite()) covariances_.Set(point.slot, there.id, covariance);
  }
}

// Level II (Eq. 15).
void Tracker::FollowHidden(bool catch_up, FrameReport* report) {
  if (!levels_->HasLevelTwo()) return;
  Timer timer;
  NoteRecalled();
  NoteNewNodes();
  report->updated_pi += levels_->SolveLevelTwo(&memory_, &map_).variable_nodes;
  if (catch_up) report->updated_pi += levels_->CatchUp(&memory_, &map_).variable_nodes;
  report->times.level2 += timer.Restart();
  UpdateVisible(map_, map_.state().camera_from_map, camera_, &visible_);
  report->times.warp += timer.Restart();
}

// Level I and II.
void Tracker::Deform(const ObservedSurface& surface, bool catch_up, FrameReport* report) {
  memory_.BeginFrame(levels_->point_relevant(), &map_);
  // The weights stay the same for all solves of the frame.
  if (options_.levels.yield_strain > 0.0) {
    UpdateEdgeWeights(levels_->point_relevant().nodes(), options_.levels.yield_strain, &map_);
  }
  levels_->BeginFrame();
  if (options_.covariance) {
    std::vector<PointBinding> bindings;
    bindings.reserve(visible_.size());
    for (const VisiblePoint& point : visible_) bindings.push_back(map_.binding(point.slot));
    nodes_before_.Take(bindings, map_.state());
  }
  const FrameObservations observations = FollowSeen(surface, report);
  if (options_.covariance) MeasureCovariances(observations, report);
  FollowHidden(catch_up, report);
  report->fault = levels_->TakeFault();
  const bool moved = report->active > 0;
  if (batch_ != nullptr && moved && report->number % options_.verify_every == 0) {
    Verify(observations, report);
  }
  memory_.Keep(levels_->point_relevant(), map_);
}

void Tracker::FollowTissue(const ObservedSurface& surface, bool catch_up, FrameReport* report) {
  if (!options_.rigid) Deform(surface, catch_up, report);
  Timer timer;
  features_.DropOutliers(map_, std::max(surface.noise(), kLeastFeatureDeviation));
  const AssociationResult association =
      Associate(visible_, map_.state().camera_from_map, surface, AssociationOptions());
  Measure(association, surface.noise(), report);
  points_before_ = report->points;
  report->times.associate += timer.Restart();
  Fuse(association, report->number, surface.noise());
  report->times.warp += timer.Restart();
}

void Tracker::Verify(const FrameObservations& observations, FrameReport* report) {
  const Timer timer;
  DeformableMap copy = map_;
  std::vector<int> nodes(copy.graph().num_nodes());
  std::iota(nodes.begin(), nodes.end(), 0);
  memory_.UpdatePriors(nodes, &copy);
  levels_->CatchUpCopy(&memory_, &copy);
  report->batch = batch_->Compare(observations, copy);
  report->times.verify = timer.Seconds();
}

// Measures how well the deformed map lies on the surface.
void Tracker::Measure(const AssociationResult& association, double noise, FrameReport* report) {
  noise = std::max(noise, kLeastNoise);
  const double width = kInlierWidth * std::max(association.deviation, noise);
  double squares = 0.0;
  for (const Association& m : association.matches) {
    if (std::abs(m.ScaledDistance()) > width) continue;
    ++report->inliers;
    squares += m.distance * m.distance;
  }
  report->points = static_cast<int>(association.matches.size());
  report->overlap = association.MatchedShare();
  int tentative = 0;
  for (const VisiblePoint& point : visible_) {
    if (map_.point(point.slot).IsTentative()) ++tentative;
  }
  report->tentative = tentative / std::max(1.0, static_cast<double>(visible_.size()));
  report->rms_plane = std::sqrt(squares / std::max(1, report->inliers)) * unit_;
  report->features = features_.size();
}

// Averages the points of the map with the observed surface (a running mean), and removes points
// that the camera sees through. A tentative point has to lie on the surface wherever that is
// measured.
void Tracker::Fuse(const AssociationResult& association, int frame, double noise) {
  const CameraPose& pose = map_.state().camera_from_map;
  const double width =
      kInlierWidth * std::max({association.deviation, noise, kLeastInlierDeviation});
  for (const Association& m : association.matches) {
    const int slot = visible_[m.visible].slot;
    MapPoint point = map_.point(slot);
    if (std::abs(m.ScaledDistance()) > width) {
      if (point.IsTentative()) Contradict(m.visible, point);
      continue;
    }
    const PointBinding binding = map_.binding(slot);
    const LocalWarp warp = map_.WarpOf(binding);
    const double share = m.weight / (point.weight + m.weight);
    // The correction is along the normal only, because back-projection does not determine positions
    // along the surface.
    const Eigen::Vector3d correction = pose.rotation.conjugate() * (-m.distance * m.patch->normal);
    point.position += share * (warp.gradient.inverse() * correction);
    const Eigen::Vector3d normal =
        warp.gradient.transpose() * (pose.rotation.conjugate() * m.patch->normal);
    point.normal = ((1.0 - share) * point.normal + share * normal.normalized()).normalized();
    point.weight = std::min(point.weight + m.weight, options_.max_point_weight);
    point.contradictions = std::max(0, point.contradictions - 1);
    ++point.sightings;
    point.last_seen = frame;
    map_.SetPoint(slot, point);
  }
  for (const int i : association.seen_through) Contradict(i, map_.point(visible_[i].slot));
  const auto gone = [](const VisiblePoint& point) { return point.slot < 0; };
  visible_.erase(std::remove_if(visible_.begin(), visible_.end(), gone), visible_.end());
}

void Tracker::Contradict(int visible, MapPoint point) {
  const int slot = visible_[visible].slot;
  ++point.contradictions;
  if (!point.IsRefuted()) {
    map_.SetPoint(slot, point);
    return;
  }
  map_.RemovePoint(slot);
  visible_[visible].slot = -1;
}

void Tracker::Grow(const SlamFrame& frame, const ObservedSurface& surface, FrameReport* report) {
  Timer timer;
  nodes_before_growth_ = map_.graph().num_nodes();
  const MapGrowthResult growth =
      GrowMap(visible_, surface, frame.color, frame.number, options_.growth, &map_);
  report->explained = growth.explained;
  report->times.grow += timer.Restart();
  if (frame.color.empty() || !options_.features) return;
  if (report->status == FrameStatus::kInitialized) {
    features_.Track(frame.color, surface, map_, map_.state().camera_from_map);
  }
  features_.Replenish(surface, map_);
  report->times.features += timer.Restart();
}

}  // namespace ceres_ed
