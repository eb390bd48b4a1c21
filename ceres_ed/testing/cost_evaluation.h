// Evaluates a cost function once and records every fault, and computes numeric Jacobians. The
// checkers of the laws are built from these functions.
#ifndef CERES_ED_TESTING_COST_EVALUATION_H_
#define CERES_ED_TESTING_COST_EVALUATION_H_

#include <string>
#include <vector>

#include <Eigen/Core>
#include <ceres/cost_function.h>

namespace ceres_ed {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The result of an evaluation.
struct CostEvaluation {
  // The value that CostFunction::Evaluate returned.
  bool evaluated = false;
  // The residuals. Values that were not written are NaN.
  Eigen::VectorXd residuals;
  // One Jacobian for each block; 0 x 0 if it was not asked for.
  std::vector<RowMajorMatrix> jacobians;
  // True if something was written behind the end of an array.
  bool overrun = false;

  // Returns whether all residuals and Jacobians are finite.
  bool IsFinite() const;
};

// Returns the residuals and the Jacobians of the blocks with a non-zero `wanted`. For the other
// blocks the function passes null pointers, as Ceres does for constant blocks.
CostEvaluation EvaluateCost(const ceres::CostFunction& cost,
                            const std::vector<std::vector<double>>& blocks,
                            const std::vector<char>& wanted);

// Returns only the residuals. The array of Jacobians is null.
CostEvaluation EvaluateResiduals(const ceres::CostFunction& cost,
                                 const std::vector<std::vector<double>>& blocks);

// Returns true if the residuals, and the Jacobians that both have, have the same bits.
bool EqualToTheBit(const CostEvaluation& a, const CostEvaluation& b);

// Returns the Jacobian of one block by Ridders' extrapolation of central differences, beginning
// with the step `step` > 0. It is NaN if the cost can't be evaluated.
RowMajorMatrix NumericJacobian(const ceres::CostFunction& cost,
                               const std::vector<std::vector<double>>& blocks,
                               int block,
                               double step);

}  // namespace ceres_ed

#endif  // CERES_ED_TESTING_COST_EVALUATION_H_
