#include <ceres_ed/linear_algebra/block_cholesky.h>
#include <ceres_ed/solver/steps/step_solver.h>

namespace ceres_ed {
namespace {

class FactorStep final : public StepSolver {
 public:
  FactorStep(const BlockStructure& structure, FactorMemory* memory)
      : cholesky_(structure, /*num_trailing=*/0, memory) {}

  bool Solve(const StepSystem& system, Eigen::VectorXd* x) override {
    if (!cholesky_.Factorize(system.values, *system.damping, system.num_threads)) return false;
    *x = cholesky_.Solve(*system.rhs);
    return true;
  }

 private:
  BlockCholesky cholesky_;
};

}  // namespace

std::unique_ptr<StepSolver> MakeFactorStep(const BlockStructure& structure, FactorMemory* memory) {
  return std::make_unique<FactorStep>(structure, memory);
}

}  // namespace ceres_ed
