// Solves a problem by levels: all of it at once, or its levels one by one.
#ifndef CERES_ED_SOLVER_DECOUPLING_DECOUPLED_SOLVER_H_
#define CERES_ED_SOLVER_DECOUPLING_DECOUPLED_SOLVER_H_

#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/decoupling/config_solver.h>
#include <ceres_ed/solver/decoupling/decoupling.h>
#include <ceres_ed/solver/strategy.h>

namespace ceres_ed {

// The implementation of every strategy. The strategies differ only in their rows of the table
// (strategies/strategy_table.h), which state which nodes Level I moves and how the others follow.
//
// A fit calls Solve(). Tracking calls UpdateNodes() on its map, builds the problem of Level I over
// a window of the map, solves it, and solves parts of Level II when they are needed.
class DecoupledSolver final : public Strategy {
 public:
  explicit DecoupledSolver(const StrategyOptions& options);

  SolveSummary Solve(const ProblemBuilder& builder,
                     const SolverOptions& options,
                     DeformationState* state) override;

  // Returns the nodes of the next Level I, depending on those of the last one
  // (Decoupler::Update()).
  const Decoupling& UpdateNodes(const DeformationGraph& graph, const NodeSet& point_relevant) {
    return decoupler_.Update(graph, point_relevant);
  }

  // Returns the PI nodes that Level I moves by ActiveSetRule::kInformation. It changes with what it
  // is shown (ActiveSet::Look()) and when a frame begins.
  ActiveSet& active_set() { return decoupler_.active_set(); }
  const ActiveSet& active_set() const { return decoupler_.active_set(); }
  // Returns whether Level I asks the active set.
  bool HasActiveSet() const { return has_active_set_; }

  // Minimise the problem of a config over `state`, like ConfigSolver. Each level keeps its own
  // structure.
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

  // Returns whether there may be nodes that Level I does not move.
  bool HasLevelTwo() const;
  // Returns whether Level I eliminates nodes.
  bool Eliminates() const;

  const Marginalization& marginalization() const { return level_one_.marginalization(); }
  // Returns how often the nodes of Level I were chosen again.
  int num_choices() const { return decoupler_.num_choices(); }

 private:
  bool SolveActiveSet(const ProblemBuilder& builder,
                      const NodeSet& point_relevant,
                      const SolverOptions& options,
                      DeformationState* state,
                      SolveSummary* summary);
  bool Follow(const ProblemBuilder& builder,
              const std::vector<char>& point_relevant,
              const SolverOptions& options,
              double time_left_s,
              DeformationState* state,
              SolveSummary* summary);

  SolveMode mode_;
  bool has_active_set_;
  // The size of the last graph of Solve().
  int num_nodes_ = 0;
  Decoupler decoupler_;
  ConfigSolver level_one_;
  ConfigSolver level_two_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_DECOUPLING_DECOUPLED_SOLVER_H_
