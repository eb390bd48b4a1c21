#include "ceres_ed/registration/finish/finish_system.h"

#include <ceres_ed/linear_algebra/conjugate_gradients.h>

#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr double kTolerance = 0.01;
constexpr int kMaxIterations = 40;

}  // namespace

FinishSystem::FinishSystem(const SparseCholesky::Matrix& smoothness,
                           std::function<bool()> should_stop)
    : smoothness_(smoothness), should_stop_(std::move(should_stop)) {
  if (should_stop_()) return;
  if (smoothness.cols() > kMaxFactorVertices) {
    full_ = smoothness.selfadjointView<Eigen::Lower>();
  } else {
    lower_ = smoothness;
    factor_ = std::make_unique<SparseCholesky>(lower_, should_stop_);
  }
}

bool FinishSystem::SetWeights(const Eigen::VectorXd& weights) {
  if (should_stop_()) return false;
  if (factor_ == nullptr) {
    for (int v = 0; v < weights.size(); ++v) {
      full_.coeffRef(v, v) = smoothness_.valuePtr()[smoothness_.outerIndexPtr()[v]] + weights[v];
    }
    return true;
  }
  // The diagonal is the first entry of each column.
  for (int v = 0; v < weights.size(); ++v) {
    const int diagonal = lower_.outerIndexPtr()[v];
    lower_.valuePtr()[diagonal] = smoothness_.valuePtr()[diagonal] + weights[v];
  }
  const bool done = factor_->Factorize(lower_, should_stop_);
  CHECK(done || should_stop_()) << "a sum of squares and a positive diagonal";
  return done;
}

bool FinishSystem::Solve(const Eigen::MatrixXd& rhs, Eigen::MatrixXd* solution) {
  if (should_stop_()) return false;
  if (factor_ != nullptr) {
    *solution = factor_->Solve(rhs);
    return true;
  }
  // Later steps correct what an early one leaves.
  ConjugateGradientOptions options;
  options.tolerance = kTolerance;
  options.max_iterations = kMaxIterations;
  options.should_stop = should_stop_;
  ThreeColumns columns;
  if (!SolveByConjugateGradients(full_, rhs, options, &columns)) return false;
  *solution = columns;
  return true;
}

}  // namespace ceres_ed
