// The input and the result of a fit.
#ifndef CERES_ED_REGISTRATION_FIT_TYPES_H_
#define CERES_ED_REGISTRATION_FIT_TYPES_H_

#include <ceres_ed/energy/energy.h>
#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/graph/skinning.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/problem/problem_types.h>
#include <ceres_ed/registration/evidence/fit_evidence.h>
#include <ceres_ed/registration/fit_options.h>
#include <ceres_ed/solver/solver_types.h>

#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The input of a fit. A target or landmarks are required.
struct FitInput {
  // The surface that is deformed.
  PointCloud source;
  // The surface to which the source is fitted; empty if there are only landmarks.
  PointCloud target;
  // Source points with known positions in the target frame.
  std::vector<Landmark> landmarks;
  // Source points that do not move. They determine the frame, so that there is no rigid stage.
  std::vector<int> fixed_points;
};

// The pairs that a matching found, and their statistics.
struct Matches {
  std::vector<Correspondence> correspondences;
  // Further data of the pairs, by Correspondence::detail; empty if they were not requested.
  std::vector<MatchDetail> details;
  // The number of pairs with a closest point, and the number of pairs that were accepted.
  int candidates = 0;
  int inliers = 0;
  // The root mean square point-to-plane and point-to-point distance of the accepted pairs.
  double rms_plane = 0.0;
  double rms_point = 0.0;
  // 1.4826 times the median point-to-point distance of the candidates.
  double robust_distance = 0.0;
};

// The times of the stages of a fit, in seconds.
struct FitTimes {
  double prepare = 0.0;
  double rigid = 0.0;
  double graph = 0.0;
  double associate = 0.0;
  double build = 0.0;
  double solve = 0.0;
  double level1 = 0.0;
  double level2 = 0.0;
  // The finish of every vertex, including unfolding.
  double finish = 0.0;
};

// How well the position of every point is determined:
//   Cov(p) = k (x_p (J_p Z J_p^T + sum_m e_m e_m^T) + M_p + mean_w d_w d_w^T),  Z = (J^T W J)^-1
// J is the Jacobian of all residuals at the end of the fit, W gives them the weights with which
// they are in units of their standard deviations (uncertainty/statistical_weights.h), and J_p is
// the Jacobian of the warped point. e_m is the error of the point if the deformation has one
// standard deviation of a smooth mode of the whole body (uncertainty/smooth_modes.h), which the
// priors resist where no data determine it. x_p is 1 where nodes have data, and 1 + r^2 where none
// has, with the ratio r of the hidden to the seen part: the modes left out grow with it. M_p is
// the motion along the surface that the fit has held back (uncertainty/missed_motion.h). d_w leads
// to where another way of the fit has put the point (uncertainty/way_spread.h): wrong matches,
// where the ways differ in them. k = kScale is fitted to known errors
// (scripts/bench_uncertainty.py). The rigid placement is part of it: no prior holds the nodes
// against a common motion.
struct FitUncertainty {
  // k, without unit.
  static constexpr double kScale = 1.7;

  // Cov(p) of each source point in the frame of the target, in its squared unit; NaN if a node to
  // which the point is bound is undetermined. Empty if it was not requested or cannot be computed;
  // in the second case a warning gives the reason.
  std::vector<Eigen::Matrix3d> covariances;
  // The nodes of the warp that are undetermined in some direction, in ascending order.
  std::vector<int> undetermined_nodes;
  // The computation time in seconds.
  double time = 0.0;

  // Returns the square root of the trace of each covariance, in the unit of the target.
  std::vector<double> StandardDeviations() const;
};

// The state of a fit after one round on its finest graph.
struct FitRound {
  // The factor of the weights of E_rot and E_reg in this round.
  double stiffness = 1.0;
  // The number of pairs, and the root mean square point-to-plane distance, in the target's unit.
  int inliers = 0;
  double rms_plane = 0.0;
  // The energies with the final weights, so that rounds can be compared.
  EnergySummary energy;
};

// The result of a fit. Its initial status is failed.
struct FitResult {
  SolveStatus status = SolveStatus::kFailed;
  std::string message = "not fitted";
  // The warp, in the source frame. It maps any cloud in that frame to the target frame.
  Warp warp;
  // The binding of the source's points to the nodes of the warp.
  Skinning skinning;
  // The points and normals of the deformed source in the target frame and unit.
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;
  // target_from_source, the rigid placement.
  Similarity rigid;
  // 1 for nodes that an observation depended on in the last round (PR nodes), else 0.
  std::vector<char> point_relevant;
  // With SolveMode::kTwoLevel: the number of PI nodes that Level I moved in the last round.
  int active_hidden = 0;
  // With ActiveSetRule::kInformation: the energy that the held nodes would lose at once, as a share
  // of the energy of Level I, and the mutual information between observed and held nodes in nats
  // (solver/decoupling/information_loss.h). They are NaN if they were not measured.
  double held_share = std::numeric_limits<double>::quiet_NaN();
  double information_lost = std::numeric_limits<double>::quiet_NaN();
  // The matches of the last round, without unit except for the rms values (in the target's unit;
  // after the finish).
  Matches matches;
  EnergySummary initial_energy;
  EnergySummary final_energy;
  // Every round on the finest graph, in order; empty unless FitOptions::record_rounds.
  std::vector<FitRound> rounds;
  int outer_iterations = 0;
  int solver_iterations = 0;
  // The largest distance of a fixed point from its position, in the target's unit; 0 if there are
  // none.
  double max_fixed_error = 0.0;
  // Whether the deformation was discarded because it explained less than the rigid placement.
  bool rigid_only = false;
  // Whether the nodes have one rigid motion because the surfaces show no deformation beyond their
  // noise (hypotheses/model_selection.h).
  bool rigid_suffices = false;
  // The name of the hypothesis that the fit went on with (hypotheses/hypothesis.h); empty if there
  // was only one graph.
  std::string hypothesis;
  // The standard deviation of the target's noise across its surface, in the target's unit.
  double noise = 0.0;
  // The number of faces that were folded over and have been laid flat.
  int unfolded = 0;
  FitUncertainty uncertainty;
  // What the fit shows about its own quality.
  FitEvidence evidence;
  FitTimes times;
  std::vector<std::string> warnings;

  // Returns whether the result can be used, that is, whether the fit has not failed.
  bool IsUsable() const { return status != SolveStatus::kFailed; }
  // Returns whether the fit has failed or was stopped before its end.
  bool EndedEarly() const {
    return status != SolveStatus::kConverged && status != SolveStatus::kMaxIterations;
  }
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FIT_TYPES_H_
