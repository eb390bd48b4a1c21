#include "ceres_ed/registration/placement.h"

#include <ceres_ed/registration/rigid/rigid_registration.h>

#include <utility>

namespace ceres_ed {
namespace {

// Returns the pose that changes the unit of the source alone.
Similarity UnitPose(const RigidOptions& options) {
  Similarity pose;
  pose.scale = options.initial_scale;
  return pose;
}

// Returns the pose that the landmarks determine, or UnitPose() if they do not determine one.
Similarity PoseFromLandmarks(const FitInput& input, const RigidOptions& options) {
  const Similarity unit = UnitPose(options);
  std::vector<Eigen::Vector3d> from;
  std::vector<Eigen::Vector3d> to;
  for (const Landmark& landmark : input.landmarks) {
    from.push_back(unit * input.source.points[landmark.point]);
    to.push_back(landmark.position);
  }
  const StatusOr<Similarity> pose = Similarity::FitPoints(from, to, options.with_scale);
  return pose.ok() ? *pose * unit : unit;
}

}  // namespace

Placement PlaceSurfaces(const FitInput& input,
                        const Surface& source,
                        const FitOptions& options,
                        const std::function<bool()>& should_stop) {
  Placement placement;
  const bool is_rigid_stage = options.rigid_first && input.fixed_points.empty();
  placement.given =
      is_rigid_stage ? PoseFromLandmarks(input, options.rigid) : UnitPose(options.rigid);
  placement.target_from_source = placement.given;
  if (input.target.empty() || should_stop()) return placement;
  PreparedSurface prepared =
      PrepareSurface(input.target, "the target", options.num_threads, should_stop);
  placement.target = std::move(prepared.surface);
  placement.notes = std::move(prepared.notes);
  if (should_stop()) return placement;

  RigidOptions rigid = options.rigid;
  rigid.num_threads = options.num_threads;
  rigid.should_stop = should_stop;
  bool reversed = false;
  if (AreBothClosed(source, *placement.target, &reversed)) rigid.both_sides = false;
  if (reversed) placement.target = Reversed(*placement.target, options.num_threads);
  bool reversed_by_pose = false;
  if (is_rigid_stage) {
    const RigidResult result =
        AlignRigid(source, *placement.target, placement.target_from_source, rigid);
    placement.target_from_source = result.target_from_source;
    reversed_by_pose = result.reversed;
    placement.score = result.score;
    placement.runner_up = result.runner_up;
    placement.curvature = result.curvature;
  } else {
    reversed_by_pose = IsReversedAt(source, *placement.target, placement.target_from_source, rigid);
  }
  if (reversed_by_pose) placement.target = Reversed(*placement.target, options.num_threads);
  if (reversed || reversed_by_pose) {
    placement.notes.push_back(
        "source and target have opposite orientations (winding or normals): the target is taken "
        "inside out");
  }
  return placement;
}

}  // namespace ceres_ed
