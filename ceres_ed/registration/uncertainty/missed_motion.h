// What a fit misses of a deformation because the shape does not show it.
#ifndef CERES_ED_REGISTRATION_UNCERTAINTY_MISSED_MOTION_H_
#define CERES_ED_REGISTRATION_UNCERTAINTY_MISSED_MOTION_H_

#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/registration/uncertainty/smooth_modes.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Smooth bodies slide along themselves: a motion within the surface changes no distance, and the
// priors hold it back. The smooth modes show how much of a motion a fit holds back: hardly anything
// of a body with limbs, more of a round one, and more under noise, which asks for stiffness.
// Deformations have shorter waves, too, which it holds back more. With the motion that it has found
// as the measure of what there was,
//   variance of a coordinate = kWaves f mean |t_j|^2 / 3,
// over the observed nodes, with the share f of the variance of the modes that is held back. Lengths
// are in the unit frame.
class MissedMotion {
 public:
  // How many times more of a deformation is held back than of its smooth modes. It was found on
  // bodies with known deformations (scripts/bench_uncertainty.py).
  static constexpr double kWaves = 5.0;
  // The variance across a seen surface, whose distances are known, as a part of that along it.
  static constexpr double kAcross = 0.1;

  MissedMotion() = default;
  // `held_back[m]` has the changes of all nodes that the fit misses of one unit of modes[m]:
  // H^-1 H_prior v_m with the weights with which it was made. It is empty if there are no priors.
  MissedMotion(const DeformationGraph& graph,
               const DeformationState& state,
               const std::vector<char>& is_observed,
               const std::vector<SmoothMode>& modes,
               const std::vector<Eigen::VectorXd>& held_back);

  // Returns f, within [0, 1].
  double share() const { return share_; }

  // Returns the covariance of a point. `seen` is the weight of its nodes with data, in [0, 1]:
  // where there are none, its motion along `normal` (of unit length, or zero if unknown) is missed,
  // too.
  Eigen::Matrix3d Covariance(double seen, const Eigen::Vector3d& normal) const;

 private:
  double share_ = 0.0;
  double variance_ = 0.0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_UNCERTAINTY_MISSED_MOTION_H_
