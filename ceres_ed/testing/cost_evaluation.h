// One evaluation of a cost function with everything that can be wrong about it, and numeric
// Jacobians: what the law checkers are made of.
#ifndef CERES_ED_TESTING_COST_EVALUATION_H_
#define CERES_ED_TESTING_COST_EVALUATION_H_

#include <string>
#include <vector>

#include <Eigen/Core>
#include <ceres/cost_function.h>

namespace ceres_ed {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// What an evaluation gave.
struct CostEvaluation {
  // What CostFunction::Evaluate returned.
  bool evaluated = false;
  // Values that were not written are NaN.
  Eigen::VectorXd residuals;
  // One a block; 0 x 0 where it was not asked for.
  std::vector<RowMajorMatrix> jacobians;
  // True when something was written behind the end of an array.
  bool overrun = false;

  bool IsFinite() const;
};

// Returns the residuals and the Jacobians of the blocks with a non-zero `wanted`; the others are
// null pointers, as Ceres passes them for constant blocks.
CostEvaluation EvaluateCost(const ceres::CostFunction& cost,
                            const std::vector<std::vector<double>>& blocks,
                            const std::vector<char>& wanted);

// Returns the residuals alone: the array of Jacobians is null.
CostEvaluation EvaluateResiduals(const ceres::CostFunction& cost,
                                 const std::vector<std::vector<double>>& blocks);

// True when residuals, and the Jacobians that both have, are the same to the bit.
bool EqualToTheBit(const CostEvaluation& a, const CostEvaluation& b);

// Returns the Jacobian of one block by Ridders' extrapolation of central differences from the first
// step `step` > 0; NaN where the cost cannot be evaluated.
RowMajorMatrix NumericJacobian(const ceres::CostFunction& cost,
                               const std::vector<std::vector<double>>& blocks,
                               int block,
                               double step);

}  // namespace ceres_ed

#endif  // CERES_ED_TESTING_COST_EVALUATION_H_
