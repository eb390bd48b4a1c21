// A quadratic of any number of blocks: what is left on some parameters when others have been
// eliminated (Eq. 20).
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

// cost(x) = constant + gradient^T d + d^T hessian d / 2, with d = x - origin.
struct Quadratic {
  Eigen::VectorXd origin;
  // Symmetric and positive semi-definite, both triangles.
  Eigen::MatrixXd hessian;
  // In the range of `hessian`, as it is wherever the cost has a minimum.
  Eigen::VectorXd gradient;
  double constant = 0.0;

  double Value(const Eigen::VectorXd& d) const {
    return constant + gradient.dot(d) + 0.5 * d.dot(hessian * d);
  }
};

// The same as |root d + residual|^2 / 2 + constant.
struct SquareRootForm {
  Eigen::MatrixXd root;
  Eigen::VectorXd residual;
  double constant = 0.0;
};

// A Quadratic as a cost function over blocks of given sizes, with n = their sum:
//   [root d + residual; sqrt(2 constant)]
// Residuals: n + 1. Those of directions that cost nothing are zero, and the last one doesn't move:
// it makes the cost that of the quadratic wherever its minimum is not negative.
//
// Its Jacobian is constant and its square known: a solver that knows of Quadratic need not square
// it at every step.
class QuadraticCost final : public ceres::CostFunction {
 public:
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

  // Number of parameters.
  int size() const { return num_residuals() - 1; }
  const Quadratic& quadratic() const { return quadratic_; }

  // Another quadratic of the same size.
  void Set(Quadratic quadratic) {
    CHECK_EQ(quadratic.hessian.rows(), size());
    quadratic_ = std::move(quadratic);
    has_root_ = has_residual_ = false;
  }

  // The same Hessian about another point.
  void SetOrigin(const Eigen::VectorXd& origin, const Eigen::VectorXd& gradient, double constant) {
    quadratic_.origin = origin;
    quadratic_.gradient = gradient;
    quadratic_.constant = constant;
    has_residual_ = false;
  }

  // x - origin, block by block.
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

  // Worked out when it is first asked for; the Hessian's part is kept until it changes.
  const SquareRootForm& SquareRoot() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!has_root_) FactorHessian();
    if (!has_residual_) SolveForResidual();
    return form_;
  }

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
  // Pivots below this share of the largest one are rounding: a rigid motion costs nothing.
  static constexpr double kRankTolerance = 1e-13;

  // hessian = P^T L D L^T P with the large pivots first, so root = D^1/2 L^T P.
  void FactorHessian() const {
    ldlt_.compute(quadratic_.hessian);
    const Eigen::VectorXd D = ldlt_.vectorD();
    const double smallest = kRankTolerance * (size() > 0 ? D.maxCoeff() : 0.0);
    root_D_ = Eigen::VectorXd::Zero(size());
    for (int i = 0; i < size(); ++i) {
      if (D[i] > smallest) root_D_[i] = std::sqrt(D[i]);
    }
    // Eigen 3.4 permutes the wrong way round where the transpositions stand on the right.
    const Eigen::MatrixXd transposed = Eigen::MatrixXd(ldlt_.matrixL()) * root_D_.asDiagonal();
    form_.root = (ldlt_.transpositionsP().transpose() * transposed).transpose();
    has_root_ = true;
    has_residual_ = false;
  }

  // root^T residual = gradient.
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
