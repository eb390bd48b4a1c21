// A quadratic cost over any number of parameter blocks. It is what remains for some parameters
// after others have been eliminated (Eq. 20).
#ifndef CERES_ED_COST_FUNCTIONS_QUADRATIC_COST_H_
#define CERES_ED_COST_FUNCTIONS_QUADRATIC_COST_H_

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <ceres/cost_function.h>
#include <glog/logging.h>

namespace ceres_ed {

// A quadratic function of the parameters x:
//   cost(x) = constant + gradient^T d + d^T hessian d / 2, with d = x - origin
struct Quadratic {
  Eigen::VectorXd origin;
  // A symmetric, positive semi-definite matrix; both triangles are filled in.
  Eigen::MatrixXd hessian;
  // The gradient at `origin`. It lies in the range of `hessian`, which holds for every cost that
  // has a minimum.
  Eigen::VectorXd gradient;
  double constant = 0.0;

  // Returns the cost at x = origin + d.
  double Value(const Eigen::VectorXd& d) const {
    return constant + gradient.dot(d) + 0.5 * d.dot(hessian * d);
  }
};

// The same quadratic written as |root d + residual|^2 / 2 + constant.
struct SquareRootForm {
  Eigen::MatrixXd root;
  Eigen::VectorXd residual;
  double constant = 0.0;
};

// A Quadratic as a cost function over blocks of given sizes. With n as the sum of the sizes, it has
// n + 1 residuals:
//   [root d + residual; sqrt(2 constant)]
// The residuals of directions that cost nothing are zero. The last residual does not depend on the
// parameters. It makes the cost equal to that of the quadratic wherever the minimum of the
// quadratic is not negative.
//
// The Jacobian is constant, and its square is known: it is the Hessian. A solver that knows the
// class Quadratic therefore need not compute the square at every step.
class QuadraticCost final : public ceres::CostFunction {
 public:
  // Fails a CHECK unless the sizes of `quadratic` are the sum of `block_sizes`.
  QuadraticCost(const std::vector<int>& block_sizes, Quadratic quadratic)
      : quadratic_(std::move(quadratic)) {
    for (const int size : block_sizes) mutable_parameter_block_sizes()->push_back(size);
    int sum = 0;
    for (const int size : block_sizes) sum += size;
    CHECK_EQ(quadratic_.hessian.rows(), sum);
    CHECK_EQ(quadratic_.hessian.cols(), sum);
    CHECK_EQ(quadratic_.origin.size(), sum);
    CHECK_EQ(quadratic_.gradient.size(), sum);
    set_num_residuals(sum + 1);
  }

  // Returns the number of parameters n.
  int size() const { return num_residuals() - 1; }
  const Quadratic& quadratic() const { return quadratic_; }

  // Replaces the quadratic by another one of the same size.
  void Set(Quadratic quadratic) {
    CHECK_EQ(quadratic.hessian.rows(), size());
    quadratic_ = std::move(quadratic);
    has_root_ = has_residual_ = false;
  }

  // Moves the quadratic to another point and keeps its Hessian.
  void SetOrigin(const Eigen::VectorXd& origin, const Eigen::VectorXd& gradient, double constant) {
    quadratic_.origin = origin;
    quadratic_.gradient = gradient;
    quadratic_.constant = constant;
    has_residual_ = false;
  }

  // Returns x - origin, of size n. `parameters` has one pointer for each block.
  Eigen::VectorXd Difference(double const* const* parameters) const {
    Eigen::VectorXd d(size());
    int row = 0;
    for (std::size_t b = 0; b < parameter_block_sizes().size(); ++b) {
      const int block_size = parameter_block_sizes()[b];
      d.segment(row, block_size) = Eigen::Map<const Eigen::VectorXd>(parameters[b], block_size);
      row += block_size;
    }
    return d - quadratic_.origin;
  }

  // Returns the square-root form. It is computed at the first call. The part that depends on the
  // Hessian alone is kept until the Hessian changes. Several threads may call this at the same
  // time.
  const SquareRootForm& SquareRoot() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!has_root_) FactorHessian();
    if (!has_residual_) SolveForResidual();
    return form_;
  }

  // Computes the residuals and, where asked for, the Jacobians. Always returns true.
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    const SquareRootForm& form = SquareRoot();
    Eigen::Map<Eigen::VectorXd> r(residuals, num_residuals());
    r.head(size()) = form.root * Difference(parameters) + form.residual;
    r[size()] = std::sqrt(2.0 * std::max(0.0, form.constant));
    if (jacobians == nullptr) return true;
    int column = 0;
    for (std::size_t b = 0; b < parameter_block_sizes().size(); ++b) {
      const int block_size = parameter_block_sizes()[b];
      if (jacobians[b] != nullptr) {
        Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> J(
            jacobians[b], num_residuals(), block_size);
        J.topRows(size()) = form.root.middleCols(column, block_size);
        J.row(size()).setZero();
      }
      column += block_size;
    }
    return true;
  }

 private:
  // A pivot smaller than this fraction of the largest one counts as zero. Such pivots are rounding
  // errors; they occur since a rigid motion costs nothing.
  static constexpr double kRankTolerance = 1e-13;

  // Factors hessian = P^T L D L^T P, with large pivots first. Hence root = D^1/2 L^T P.
  void FactorHessian() const {
    ldlt_.compute(quadratic_.hessian);
    const Eigen::VectorXd D = ldlt_.vectorD();
    const double smallest = kRankTolerance * (size() > 0 ? D.maxCoeff() : 0.0);
    root_D_ = Eigen::VectorXd::Zero(size());
    for (int i = 0; i < size(); ++i) {
      if (D[i] > smallest) root_D_[i] = std::sqrt(D[i]);
    }
    // Eigen 3.4 permutes in the wrong direction when the transpositions stand on the right-hand
    // side of a product. The code therefore transposes the product.
    const Eigen::MatrixXd transposed = Eigen::MatrixXd(ldlt_.matrixL()) * root_D_.asDiagonal();
    form_.root = (ldlt_.transpositionsP().transpose() * transposed).transpose();
    has_root_ = true;
    has_residual_ = false;
  }

  // Solves root^T residual = gradient.
  void SolveForResidual() const {
    Eigen::VectorXd r = ldlt_.transpositionsP() * quadratic_.gradient;
    ldlt_.matrixL().solveInPlace(r);
    for (int i = 0; i < size(); ++i) r[i] = root_D_[i] > 0.0 ? r[i] / root_D_[i] : 0.0;
    form_.residual = r;
    form_.constant = quadratic_.constant - 0.5 * r.squaredNorm();
    has_residual_ = true;
  }

  Quadratic quadratic_;
  mutable std::mutex mutex_;
  mutable bool has_root_ = false;
  mutable bool has_residual_ = false;
  mutable Eigen::LDLT<Eigen::MatrixXd> ldlt_;
  mutable Eigen::VectorXd root_D_;
  mutable SquareRootForm form_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_COST_FUNCTIONS_QUADRATIC_COST_H_
