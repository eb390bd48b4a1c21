// The laws that every cost function of an energy must obey. The checker needs no test framework.
//
//   CostClaims claims;
//   claims.rest = {RestNode(), RestNode()};
//   for (const std::string& violation : CheckCostLaws(*cost, claims)) ADD_FAILURE() << violation;
#ifndef CERES_ED_TESTING_COST_LAWS_H_
#define CERES_ED_TESTING_COST_LAWS_H_

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <ceres/cost_function.h>

namespace ceres_ed {

// The values of all parameter blocks of a cost function, in the order of its blocks.
using ParameterBlocks = std::vector<std::vector<double>>;

// Returns A = I, t = 0 as a parameter block (12 doubles).
std::vector<double> RestNode();

// Returns a copy of a parameter block, for the claims below.
std::vector<double> CopyBlock(const double* values, int size);

// A change of the parameters that does not change the residuals.
struct CostInvariance {
  // The end of the sentence "the residuals change under ...".
  std::string name;
  // Applies the change to the parameters.
  std::function<void(ParameterBlocks* blocks)> motion;
  // True if only |r| stays the same, as under a rotation of the residual's frame.
  bool of_norm_only = false;
};

// What a cost function claims about itself.
struct CostClaims {
  // A state at rest, with one vector for each parameter block.
  ParameterBlocks rest;
  // |r|^2 at rest, which is the minimum over all states; no value if no minimum is claimed.
  std::optional<double> squared_norm_at_rest = 0.0;
  std::vector<CostInvariance> invariances;
  // States at which values must be finite; the state with all zeros is always among them. Jacobians
  // need not be right there.
  std::vector<ParameterBlocks> degenerate;
  // Takes a state that was changed at random back to where the cost function is defined (for
  // example to a unit quaternion); null if every state is allowed.
  std::function<void(ParameterBlocks* blocks)> normalize;
};

// Options of the check. All tolerances are relative to the larger of 1 and the largest value
// compared.
struct CostLawOptions {
  std::uint64_t seed = 1;
  // The number of states near rest, and of random states, >= 0.
  int num_states = 3;
  // The standard deviation of each parameter from rest, in the unit of the parameter, > 0.
  double near_deviation = 1e-3;
  double random_deviation = 0.5;
  // The first step of the numeric differences, in the unit of the parameter, > 0. The differences
  // are extrapolated to a step of zero (Ridders). The step need not be small, but the cost must be
  // smooth over it.
  double numeric_step = 1e-2;
  double jacobian_tolerance = 1e-8;
  double value_tolerance = 1e-12;
  double invariance_tolerance = 1e-10;
};

// Returns one sentence for each violated law; empty if all laws hold:
//   - The block sizes are those of `claims.rest`.
//   - |r|^2 at rest is as claimed, and it is not smaller at any other state that is tried.
//   - The claimed motions do not change the residuals.
//   - At rest, near rest and at random states, values are finite, all of them are written and
//     nothing beyond them, and the Jacobians equal numeric differences.
//   - If any subset of the Jacobians is not asked for (null, as Ceres does for constant blocks),
//     residuals and the other Jacobians have the same bits. From eleven blocks on, the subsets are
//     each block alone, and all but each block. Without an array of Jacobians the residuals are the
//     same.
//   - Values are finite at degenerate states.
std::vector<std::string> CheckCostLaws(const ceres::CostFunction& cost,
                                       const CostClaims& claims,
                                       const CostLawOptions& options = {});

}  // namespace ceres_ed

#endif  // CERES_ED_TESTING_COST_LAWS_H_
