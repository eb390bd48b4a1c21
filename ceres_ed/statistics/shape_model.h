// The mean and the principal components of a population of aligned shapes.
#ifndef CERES_ED_STATISTICS_SHAPE_MODEL_H_
#define CERES_ED_STATISTICS_SHAPE_MODEL_H_

#include <ceres_ed/statistics/shape_table.h>
#include <ceres_ed/util/status.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The point distribution model x = mean + sum_k b_k u_k of Cootes et al. (1995), with N shapes of V
// vertices. Lengths are in the unit of the table.
struct ShapeModel {
  // 3 V numbers.
  Eigen::VectorXd mean;
  // The variances of b_k in descending order (squared unit): sums of squares by N - 1.
  Eigen::VectorXd variances;
  // 3 V x K; the columns u_k are orthonormal. The entry of the largest magnitude is positive.
  Eigen::MatrixXd components;
  // N x K: b_k of each shape.
  Eigen::MatrixXd scores;
  // The sum of the variances of all components, also of those that are not in the model.
  double total_variance = 0.0;
  // The variance of each vertex: the mean squared distance from its mean, by N - 1.
  std::vector<double> vertex_variances;

  // Returns variances / total_variance.
  Eigen::VectorXd ExplainedShares() const;
};

// Returns the model of `table` with at most `max_components` components. Up to kGramShapes shapes,
// the components are those of the N x N Gram matrix. Beyond these, subspace iteration (Halko,
// Martinsson and Tropp 2011) finds them in a few passes, so that memory does not grow with N: the
// variances are then accurate to about 1e-6 of the total variance. Errors are those of the table.
StatusOr<ShapeModel> FitShapeModel(const ShapeTable& table, int max_components);

inline constexpr int kGramShapes = 1000;

// Returns the model by subspace iteration, whatever the number of shapes.
StatusOr<ShapeModel> FitShapeModelByPasses(const ShapeTable& table, int max_components);

}  // namespace ceres_ed

#endif  // CERES_ED_STATISTICS_SHAPE_MODEL_H_
