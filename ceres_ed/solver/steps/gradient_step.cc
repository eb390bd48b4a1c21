#include <ceres_ed/linear_algebra/iterative/block_conjugate_gradients.h>
#include <ceres_ed/linear_algebra/iterative/block_jacobi.h>
#include <ceres_ed/linear_algebra/iterative/incomplete_cholesky.h>
#include <ceres_ed/linear_algebra/iterative/two_level_preconditioner.h>
#include <ceres_ed/solver/steps/coarse_space.h>
#include <ceres_ed/solver/steps/step_solver.h>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

std::unique_ptr<Preconditioner> MakePreconditioner(const PrimalMatrix& matrix,
                                                   const std::vector<Eigen::Vector3d>& positions,
                                                   PreconditionerKind kind) {
  switch (kind) {
    case PreconditionerKind::kBlockJacobi:
      return std::make_unique<BlockJacobi>(matrix);
    case PreconditionerKind::kIncompleteCholesky:
      return std::make_unique<IncompleteCholesky>(matrix);
    case PreconditionerKind::kTwoLevel:
      break;
  }
  return std::make_unique<TwoLevelPreconditioner>(matrix, MakeCoarseSpace(matrix, positions));
}

class GradientStep final : public StepSolver {
 public:
  GradientStep(const BlockStructure& structure,
               const std::vector<Eigen::Vector3d>& positions,
               PreconditionerKind kind)
      : matrix_(structure), preconditioner_(MakePreconditioner(matrix_, positions, kind)) {}

  bool Solve(const StepSystem& system, Eigen::VectorXd* x) override {
    matrix_.SetValues(system.values, *system.damping);
    if (!preconditioner_->Update(system.num_threads)) return false;
    BlockGradientOptions options;
    options.tolerance = system.tolerance;
    options.num_threads = system.num_threads;
    if (system.should_stop != nullptr) options.should_stop = *system.should_stop;
    Eigen::VectorXd solution;
    const BlockGradientSummary summary =
        SolveByBlockGradients(matrix_, *system.rhs, options, preconditioner_.get(), &solution);
    VLOG(1) << "conjugate gradients: " << summary.iterations << " iterations, residual "
            << summary.relative_residual;
    if (summary.failed) return false;
    x->setZero(system.rhs->size());
    x->head(solution.size()) = solution;
    return true;
  }

 private:
  PrimalMatrix matrix_;
  std::unique_ptr<Preconditioner> preconditioner_;
};

}  // namespace

std::unique_ptr<StepSolver> MakeGradientStep(const BlockStructure& structure,
                                             const std::vector<Eigen::Vector3d>& positions,
                                             PreconditionerKind preconditioner) {
  return std::make_unique<GradientStep>(structure, positions, preconditioner);
}

}  // namespace ceres_ed
