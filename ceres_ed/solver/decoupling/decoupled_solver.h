// Solves by levels: the whole of a problem at once, or its levels one by one.
#ifndef CERES_ED_SOLVER_DECOUPLING_DECOUPLED_SOLVER_H_
#define CERES_ED_SOLVER_DECOUPLING_DECOUPLED_SOLVER_H_

#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/decoupling/config_solver.h>
#include <ceres_ed/solver/decoupling/decoupling.h>
#include <ceres_ed/solver/strategy.h>

namespace ceres_ed {

// Every strategy: they differ in their rows of the table alone (strategies/strategy_table.h), which
// say what nodes Level I moves and how the others follow.
//
// A fit calls Solve(). Tracking calls UpdateNodes() on its map, builds the problem of Level I over
// a window of it, solves that, and has parts of Level II solved when they are needed.
class DecoupledSolver final : public Strategy {
 public:
  explicit DecoupledSolver(const StrategyOptions& options);

  SolveSummary Solve(const ProblemBuilder& builder,
                     const SolverOptions& options,
                     DeformationState* state) override;

  // The nodes of the next Level I, by those of the last one (Decoupler::Update).
  const Decoupling& UpdateNodes(const DeformationGraph& graph, const NodeSet& point_relevant) {
    return decoupler_.Update(graph, point_relevant);
  }

  // Solve the problem of a config over `state`, as ConfigSolver does. Each keeps the structure of
  // its own level.
  bool SolveLevelOne(const ProblemBuilder& builder,
                     const ProblemConfig& config,
                     const SolverOptions& options,
                     DeformationState* state,
                     SolveSummary* summary) {
    return level_one_.Solve(builder, config, options, state, summary);
  }
  bool SolveLevelTwo(const ProblemBuilder& builder,
                     const ProblemConfig& config,
                     const SolverOptions& options,
                     DeformationState* state,
                     SolveSummary* summary) {
    return level_two_.Solve(builder, config, options, state, summary);
  }

  // Whether there are nodes that Level I does not move.
  bool HasLevelTwo() const;
  // Whether Level I eliminates nodes.
  bool Eliminates() const;

  const Marginalization& marginalization() const { return level_one_.marginalization(); }
  // How often the nodes of Level I were chosen anew.
  int num_choices() const { return decoupler_.num_choices(); }

 private:
  bool Follow(const ProblemBuilder& builder,
              const std::vector<char>& point_relevant,
              const SolverOptions& options,
              double time_left_s,
              DeformationState* state,
              SolveSummary* summary);

  SolveMode mode_;
  Decoupler decoupler_;
  ConfigSolver level_one_;
  ConfigSolver level_two_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_DECOUPLING_DECOUPLED_SOLVER_H_
