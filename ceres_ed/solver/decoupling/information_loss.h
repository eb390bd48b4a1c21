// How much of what is known of the observed nodes is due to holding others.
#ifndef CERES_ED_SOLVER_DECOUPLING_INFORMATION_LOSS_H_
#define CERES_ED_SOLVER_DECOUPLING_INFORMATION_LOSS_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/util/status.h>

#include <vector>

namespace ceres_ed {

// Returns the mutual information, in nats, between the observed nodes (with the camera, if there is
// one) and the held ones, in the Gaussian whose information matrix is the Gauss-Newton matrix H of
// all residuals at `state`. It is the mean, over where the held nodes h may be, of the
// Kullback-Leibler divergence between the observed nodes c as they are when h is held and as they
// are when h is marginalised. The moved PI nodes a are marginalised in both:
//   I(c; h) = (log det H_ca + log det H_ah - log det H_a - log det H_cah) / 2
// where H_ca is the part of H that belongs to c and a. A tiny multiple of the diagonal is added to
// H, so that an undetermined direction contributes nothing instead of making it singular.
//
// `observed` and `moved` have one entry for each node: non-zero if it is PR, and if Level I moves
// it. It is an error if a residual can't be evaluated. The time is that of four factorisations, of
// which one is over all nodes.
StatusOr<double> MeasureInformationLoss(const ProblemBuilder& builder,
                                        const std::vector<char>& observed,
                                        const std::vector<char>& moved,
                                        const DeformationState& state,
                                        int num_threads);

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_DECOUPLING_INFORMATION_LOSS_H_
