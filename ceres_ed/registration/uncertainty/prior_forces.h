// How the priors of a fit resist smooth motions.
#ifndef CERES_ED_REGISTRATION_UNCERTAINTY_PRIOR_FORCES_H_
#define CERES_ED_REGISTRATION_UNCERTAINTY_PRIOR_FORCES_H_

#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/registration/fit_problem.h>
#include <ceres_ed/registration/uncertainty/smooth_modes.h>

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The forces H_prior v with which the priors of a problem resist a change v of its nodes, for one
// unit of each mode.
class PriorForces {
 public:
  // Computes the forces at `state`, apart for each prior of `problem`, whose weights are the same
  // afterwards.
  PriorForces(const DeformationGraph& graph,
              const DeformationState& state,
              const std::vector<SmoothMode>& modes,
              int num_threads,
              FitProblem* problem);

  // Returns the force against each mode with the present weights of `problem`: 12 values for each
  // node, in the order of the nodes. Nodes without a prior have none. Empty if there are no priors.
  std::vector<Eigen::VectorXd> Of(const FitProblem& problem) const;

  // Returns what a fit with the present weights of `problem` misses of each mode: H^-1 H_prior v,
  // with H = J^T J of all residuals at `state`. Empty if there are no priors, or H has no factor.
  std::vector<Eigen::VectorXd> HeldBack(const FitProblem& problem,
                                        const DeformationState& state,
                                        int num_threads) const;

 private:
  std::size_t num_modes_ = 0;
  std::vector<int> terms_;
  // For each of these terms and each mode, with the weight 1.
  std::vector<std::vector<Eigen::VectorXd>> forces_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_UNCERTAINTY_PRIOR_FORCES_H_
