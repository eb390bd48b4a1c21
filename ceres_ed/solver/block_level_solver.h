// Minimises one ProblemConfig with block normal equations.
#ifndef CERES_ED_SOLVER_BLOCK_LEVEL_SOLVER_H_
#define CERES_ED_SOLVER_BLOCK_LEVEL_SOLVER_H_

#include <ceres_ed/linear_algebra/block_structure.h>
#include <ceres_ed/linear_algebra/double_buffer.h>
#include <ceres_ed/solver/level_solver.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>
#include <ceres_ed/solver/steps/step_solver.h>

#include <memory>
#include <vector>

namespace ceres_ed {

// The Levenberg-Marquardt method with the acceptance rules and tolerances of Ceres, on the same
// cost functions and losses. It keeps the block structure and what solves for a step, such as the
// symbolic factor, from one solve to the next: as long as the variable nodes are the same, pairs of
// blocks are only added to the structure, so that new correspondences rarely require a new
// analysis.
class BlockLevelSolver final : public LevelSolver {
 public:
  // `linear_solver` is kBlock, kPcg or kAuto.
  BlockLevelSolver(LinearSolver linear_solver, PreconditionerKind preconditioner)
      : linear_solver_(linear_solver), preconditioner_(preconditioner) {}

  bool Solve(const ProblemBuilder& builder,
             const ProblemConfig& config,
             const SolverOptions& options,
             DeformationState* state,
             SolveSummary* summary) override;

 private:
  // Ensures that the structure and the step solver fit the equations.
  void UpdateStructure(const ProblemBuilder& builder, const ProblemConfig& config);
  std::unique_ptr<StepSolver> MakeStepSolver(const DeformationGraph& graph);

  const LinearSolver linear_solver_;
  const PreconditionerKind preconditioner_;

  // Objects of the last problem, which are kept to reuse their memory.
  NormalEquations equations_;
  std::vector<double> values_;
  FactorMemory memory_;
  std::vector<char> variable_nodes_;
  std::vector<int> sizes_;
  std::vector<BlockPair> pairs_;
  std::unique_ptr<BlockStructure> structure_;
  std::unique_ptr<StepSolver> step_solver_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_BLOCK_LEVEL_SOLVER_H_
