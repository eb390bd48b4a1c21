// Solves one ProblemConfig on block normal equations.
#ifndef CERES_ED_SOLVER_BLOCK_LEVEL_SOLVER_H_
#define CERES_ED_SOLVER_BLOCK_LEVEL_SOLVER_H_

#include <ceres_ed/linear_algebra/block_cholesky.h>
#include <ceres_ed/linear_algebra/block_structure.h>
#include <ceres_ed/solver/level_solver.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>

#include <memory>
#include <vector>

namespace ceres_ed {

// Levenberg-Marquardt with the acceptance rules and tolerances of Ceres, on the same cost functions
// and losses. Keeps structure and symbolic factor from solve to solve: while the variable nodes
// stay the same, pairs of blocks only ever join the structure, so that new correspondences seldom
// cost a new analysis.
class BlockLevelSolver final : public LevelSolver {
 public:
  bool Solve(const ProblemBuilder& builder,
             const ProblemConfig& config,
             const SolverOptions& options,
             DeformationState* state,
             SolveSummary* summary) override;

 private:
  // Sees to it that the equations have a structure and a factor that fit them.
  void UpdateStructure(const ProblemConfig& config);

  // Those of the last problem, kept for their memory.
  NormalEquations equations_;
  std::vector<double> values_;
  FactorMemory memory_;
  std::vector<char> variable_nodes_;
  std::vector<int> sizes_;
  std::vector<BlockPair> pairs_;
  std::unique_ptr<BlockStructure> structure_;
  std::unique_ptr<BlockCholesky> cholesky_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_BLOCK_LEVEL_SOLVER_H_
