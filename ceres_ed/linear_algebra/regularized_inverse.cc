#include "ceres_ed/linear_algebra/regularized_inverse.h"

#include <algorithm>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace ceres_ed {
namespace {

// The regularisation e, relative to the diagonal, and the factor of the stronger one.
constexpr double kRegularization = 1e-10;
constexpr double kStrongerBy = 10.0;
// The share of a variance that is lost under the stronger regularisation, above which a block is
// undetermined.
constexpr double kUndeterminedLoss = 0.1;
// The lower bound of the diagonal, relative to its mean.
constexpr double kMinRelativeDiagonal = 1e-9;

Eigen::VectorXd Scales(const BlockStructure& structure, const std::vector<double>& values) {
  const Eigen::VectorXd diagonal = structure.Diagonal(values);
  const double mean = diagonal.size() > 0 ? diagonal.mean() : 0.0;
  return diagonal.cwiseMax(mean > 0.0 ? kMinRelativeDiagonal * mean : 1.0);
}

// Returns the largest share of its variance that a direction loses from `weak` to `strong`: the
// largest eigenvalue of (weak - strong) x = share * weak x. `scales` gives all parameters the same
// units.
double LargestLoss(const Eigen::MatrixXd& weak,
                   const Eigen::MatrixXd& strong,
                   const Eigen::VectorXd& scales) {
  const Eigen::VectorXd root = scales.cwiseSqrt();
  const Eigen::MatrixXd scaled_weak = root.asDiagonal() * weak * root.asDiagonal();
  const Eigen::MatrixXd lost = root.asDiagonal() * (weak - strong) * root.asDiagonal();
  const Eigen::LLT<Eigen::MatrixXd> factor(scaled_weak);
  if (factor.info() != Eigen::Success) return 1.0;
  const Eigen::MatrixXd half = factor.matrixL().solve(lost);
  const Eigen::MatrixXd relative = factor.matrixL().solve(half.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(relative, Eigen::EigenvaluesOnly);
  const double largest = solver.eigenvalues().maxCoeff();
  return largest >= 0.0 ? largest : 1.0;
}

}  // namespace

std::unique_ptr<RegularizedInverse> RegularizedInverse::Create(BlockStructure structure,
                                                               const std::vector<double>& values,
                                                               int num_threads) {
  std::unique_ptr<RegularizedInverse> inverse(new RegularizedInverse(std::move(structure)));
  if (!inverse->Invert(values, num_threads)) return nullptr;
  return inverse;
}

bool RegularizedInverse::Invert(const std::vector<double>& values, int num_threads) {
  const Eigen::VectorXd scales = Scales(structure_, values);
  if (!scales.allFinite()) return false;
  const Eigen::VectorXd added = kRegularization * scales;
  if (!weak_.Factorize(values.data(), added, num_threads) ||
      !strong_.Factorize(values.data(), kStrongerBy * added, num_threads)) {
    return false;
  }
  inverse_.emplace(weak_.Invert());
  const SelectedInverse stronger = strong_.Invert();
  Eigen::MatrixXd weak;
  Eigen::MatrixXd strong;
  for (int i = 0; i < structure_.num_blocks(); ++i) {
    inverse_->Block(i, i, &weak);
    stronger.Block(i, i, &strong);
    const Eigen::VectorXd of_block = scales.segment(structure_.row_offset(i), structure_.size(i));
    is_determined_.push_back(LargestLoss(weak, strong, of_block) < kUndeterminedLoss ? 1 : 0);
  }
  // Forms (1 + a) Z(e) - a Z(10 e) with a = 1 / 9, up to the factor 10 / 9 that PropagateSelected()
  // applies.
  inverse_->AddScaled(-1.0 / kStrongerBy, stronger);
  return true;
}

bool RegularizedInverse::PropagateSelected(const std::vector<BlockDerivative>& parts,
                                           Eigen::MatrixXd* result) const {
  const Eigen::Index rows = parts.empty() ? 0 : parts.front().jacobian.rows();
  result->setZero(rows, rows);
  Eigen::MatrixXd block;
  bool complete = true;
  for (std::size_t a = 0; a < parts.size(); ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      if (!inverse_->Block(parts[a].block, parts[b].block, &block)) complete = false;
      const Eigen::MatrixXd term = parts[a].jacobian * (block * parts[b].jacobian.transpose());
      *result += term;
      if (a != b) *result += term.transpose();
    }
  }
  *result *= kStrongerBy / (kStrongerBy - 1.0);
  return complete;
}

Eigen::VectorXd RegularizedInverse::SolveLocked(const Eigen::VectorXd& rhs) const {
  return (kStrongerBy * weak_.Solve(rhs) - strong_.Solve(rhs)) / (kStrongerBy - 1.0);
}

Eigen::VectorXd RegularizedInverse::Solve(const Eigen::VectorXd& rhs) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return SolveLocked(rhs);
}

Eigen::MatrixXd RegularizedInverse::Solve(const std::vector<BlockDerivative>& parts) const {
  const Eigen::Index rows = parts.front().jacobian.rows();
  Eigen::MatrixXd result(rows, rows);
  const std::lock_guard<std::mutex> lock(mutex_);
  for (Eigen::Index r = 0; r < rows; ++r) {
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(structure_.num_rows());
    for (const BlockDerivative& part : parts) {
      rhs.segment(structure_.row_offset(part.block), structure_.size(part.block)) +=
          part.jacobian.row(r).transpose();
    }
    const Eigen::VectorXd solved = SolveLocked(rhs);
    result.col(r).setZero();
    for (const BlockDerivative& part : parts) {
      result.col(r) += part.jacobian * solved.segment(structure_.row_offset(part.block),
                                                      structure_.size(part.block));
    }
  }
  return 0.5 * (result + result.transpose());
}

Eigen::MatrixXd RegularizedInverse::Propagate(const std::vector<BlockDerivative>& parts) const {
  Eigen::MatrixXd result;
  if (!PropagateSelected(parts, &result)) result = Solve(parts);
  return result;
}

}  // namespace ceres_ed
