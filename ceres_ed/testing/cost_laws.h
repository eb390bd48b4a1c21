// The laws that every cost function of an energy obeys, checked without a test framework.
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

// The values of all parameter blocks of a cost function, in its order.
using ParameterBlocks = std::vector<std::vector<double>>;

// Returns A = I, t = 0 as a parameter block (12 doubles).
std::vector<double> RestNode();

// Returns a copy of a parameter block, for the claims below.
std::vector<double> CopyBlock(const double* values, int size);

// A motion of the parameters that leaves the residuals as they are.
struct CostInvariance {
  // Ends the sentence "the residuals change under ...".
  std::string name;
  std::function<void(ParameterBlocks* blocks)> motion;
  // True when only |r| stays, as for a rotation of the residual's frame.
  bool of_norm_only = false;
};

// What a cost function says of itself.
struct CostClaims {
  // A state at rest, one vector a parameter block.
  ParameterBlocks rest;
  // |r|^2 at rest, which no other state undercuts; nothing where no minimum is claimed.
  std::optional<double> squared_norm_at_rest = 0.0;
  std::vector<CostInvariance> invariances;
  // States at which values must be finite; all zeros is always tried. Jacobians need not be right
  // there.
  std::vector<ParameterBlocks> degenerate;
  // Puts a state that was moved at random back where the cost function is defined (a unit
  // quaternion); null where every state will do.
  std::function<void(ParameterBlocks* blocks)> normalize;
};

// How hard the laws are tried. All tolerances are relative to the greater of 1 and the largest
// value compared.
struct CostLawOptions {
  std::uint64_t seed = 1;
  // States near rest and at random, each; >= 0.
  int num_states = 3;
  // Deviation of each parameter from rest, unit of the parameter, > 0.
  double near_deviation = 1e-3;
  double random_deviation = 0.5;
  // First step of the numeric differences, unit of the parameter, > 0. They are extrapolated to a
  // step of zero (Ridders), so it need not be small, but the cost must be smooth over it.
  double numeric_step = 1e-2;
  double jacobian_tolerance = 1e-8;
  double value_tolerance = 1e-12;
  double invariance_tolerance = 1e-10;
};

// Returns one sentence for each violated law; empty when all hold:
//   - the block sizes are those of `claims.rest`;
//   - |r|^2 at rest is as claimed, and at no other tried state is it less;
//   - the claimed motions leave the residuals as they are;
//   - at rest, near rest and at random, values are finite, all are written and nothing beyond them,
//     and the Jacobians equal numeric differences;
//   - with any subset of the Jacobians not asked for (null, as Ceres does for constant blocks; from
//     eleven blocks on: each one alone, and all but each one), residuals and the other Jacobians
//     are the same to the bit; without a Jacobian array the residuals are the same;
//   - values are finite at degenerate states.
std::vector<std::string> CheckCostLaws(const ceres::CostFunction& cost,
                                       const CostClaims& claims,
                                       const CostLawOptions& options = {});

}  // namespace ceres_ed

#endif  // CERES_ED_TESTING_COST_LAWS_H_
