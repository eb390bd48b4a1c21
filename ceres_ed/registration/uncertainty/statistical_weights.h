// The weights with which the energies of a fit are a likelihood and a prior.
#ifndef CERES_ED_REGISTRATION_UNCERTAINTY_STATISTICAL_WEIGHTS_H_
#define CERES_ED_REGISTRATION_UNCERTAINTY_STATISTICAL_WEIGHTS_H_

#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/fit_problem.h>

#include <vector>

namespace ceres_ed {

// Returns for each term of `problem` the weight with which its residuals at `state` are in units of
// their standard deviations. A fit weighs its energies so that it finds the deformation; that says
// little about how large their residuals usually are. Here they are measured at the end of the fit:
//   - Matches: their mean square. Together they count as one measurement for each observed node,
//     because neighbouring matches err together.
//   - Point-to-point between surfaces says nothing about sliding: it is no more than the knowledge
//     that the surface slid by less than a tenth of its diagonal.
//   - E_rot and other priors on one node: their mean square at observed nodes.
//   - E_reg and other priors between nodes: the mean square of |r|^2 / |g_k - g_j|^2 over pairs of
//     observed nodes that are a tenth to four tenths of the diagonal apart, where r is the residual
//     that E_reg would have between them. Neighbours alone would say too little: deformations are
//     smooth, so the residuals of neighbouring edges are alike and do not average out.
//   - Landmarks and fixed points: their mean square. Energies of the user keep their weights,
//     unless they are matches.
// Lengths are in the unit frame.
std::vector<double> StatisticalWeights(const FitProblem& problem,
                                       const BuiltGraph& graph,
                                       const DeformationState& state);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_UNCERTAINTY_STATISTICAL_WEIGHTS_H_
