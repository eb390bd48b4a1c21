// What a fit takes, and what comes of it.
#ifndef CERES_ED_REGISTRATION_FIT_TYPES_H_
#define CERES_ED_REGISTRATION_FIT_TYPES_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/graph/skinning.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/problem/problem_types.h>
#include <ceres_ed/registration/fit_options.h>
#include <ceres_ed/registration/matches.h>
#include <ceres_ed/solver/solver_types.h>

#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A source point and the place that it goes to.
struct PointConstraint {
  // Index into FitInput::source.
  int point = -1;
  // In the target frame and unit.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

// What is fitted to what. A fit needs a target or landmarks.
struct FitInput {
  PointCloud source;
  // Empty: landmarks alone.
  PointCloud target;
  std::vector<PointConstraint> landmarks;
  // Source points that stay where they are. They settle the frame: there is no rigid stage then.
  std::vector<int> fixed_points;
};

// Seconds.
struct FitTimes {
  double prepare = 0.0;
  double rigid = 0.0;
  double graph = 0.0;
  double associate = 0.0;
  double build = 0.0;
  double solve = 0.0;
  double level1 = 0.0;
  double level2 = 0.0;
  // Of every vertex, unfolding included.
  double finish = 0.0;
};

// How well the data determine the warp, by the residuals of the last round and what they leave:
//   Cov(p) = s0^2 J_p (J^T J)^-1 J_p^T
// with J the Jacobian of all weighted residuals, J_p that of a warped point (solver/
// state_covariance.h) and s0^2 the variance factor of the data
// (solver/covariance/variance_factor.h). It holds on these terms: the correspondences are right,
// their errors independent; the rigid placement is known; E_rot and E_reg are Gaussian priors with
// their last weights, relative to the data; the finish and unfolding add nothing.
struct FitUncertainty {
  // Root of the trace of Cov(p), one a source point, in the source's unit; NaN where a node that
  // carries the point is undetermined. Empty where it was not asked for, or could not be had: a
  // warning says why.
  std::vector<double> std_dev;
  // s0^2, of residuals as the objective weighs them, without units.
  double variance_factor = 0.0;
  // Nodes of the warp in a direction of which nothing says anything, ascending.
  std::vector<int> undetermined_nodes;
  // Seconds.
  double time = 0.0;
};

// The outcome of a fit. It starts out failed.
struct FitResult {
  SolveStatus status = SolveStatus::kFailed;
  std::string message = "not fitted";
  // In the source frame; takes any cloud there to the target frame.
  Warp warp;
  // The binding of the source's points to the warp's nodes.
  Skinning skinning;
  // The source in the target frame and unit.
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;
  Similarity rigid;
  // 1 for nodes that an observation touched in the last round.
  std::vector<char> point_relevant;
  // Of the last round, without units but for rms (target's unit; after the finish).
  Matches matches;
  EnergySummary initial_energy;
  EnergySummary final_energy;
  int outer_iterations = 0;
  int solver_iterations = 0;
  // Largest distance of a fixed point from its place, target's unit; 0 where there are none.
  double max_fixed_error = 0.0;
  // Whether the deformation explained less than the rigid placement, and was left out.
  bool rigid_only = false;
  // Standard deviation of the target's noise across its surface, in its unit.
  double noise = 0.0;
  // Faces that were folded over and were laid flat in the end.
  int unfolded = 0;
  FitUncertainty uncertainty;
  FitTimes times;
  std::vector<std::string> warnings;

  bool IsUsable() const { return status != SolveStatus::kFailed; }
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FIT_TYPES_H_
