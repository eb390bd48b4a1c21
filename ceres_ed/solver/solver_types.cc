#include "ceres_ed/solver/solver_types.h"

#include <ceres_ed/util/options.h>

namespace ceres_ed {

const OptionTable<SolverOptions>& SolverOptions::Rows() {
  using O = SolverOptions;
  static const OptionTable<O> rows({
      Row(&O::max_iterations, "max_iterations", "The most iterations of a level.").In(AtLeast(0)),
      Row(&O::function_tolerance,
          "function_tolerance",
          "A level has converged when the cost changes by less than this part of it.")
          .In(AtLeast(0)),
      Row(&O::gradient_tolerance,
          "gradient_tolerance",
          "A level has converged when no entry of the gradient is larger.")
          .In(AtLeast(0)),
      Row(&O::parameter_tolerance,
          "parameter_tolerance",
          "A level has converged when a step is smaller than this part of the parameters.")
          .In(AtLeast(0)),
      Row(&O::initial_trust_region_radius,
          "initial_trust_region_radius",
          "The damping starts at 1 / radius.")
          .In(Above(0)),
      Row(&O::num_threads, "num_threads", "The result does not depend on it.").In(AtLeast(1)),
      Row(&O::time_limit_s, "time_limit_s", "The time after which the best state is returned.")
          .In(AboveOrInfinite(0))
          .Unit("seconds"),
      NotData(&O::should_stop),
  });
  return rows;
}

bool SolverOptions::IsValid(std::string* error) const { return Rows().Check(*this, error); }

const OptionTable<StrategyOptions>& StrategyOptions::Rows() {
  using O = StrategyOptions;
  static const OptionTable<O> rows({
      Row(&O::mode,
          "mode",
          "batch moves all nodes at once; two_level first those that are observed, then the rest; "
          "marginal does what batch does, with the rest eliminated.")
          .OnResume(ResumeRule::kNoted)
          .Main(),
      Row(&O::rings,
          "rings",
          "Level I of two_level and marginal also moves this many rings of unobserved nodes.")
          .In(AtLeast(0))
          .OnResume(ResumeRule::kNoted)
          .Main(),
      Row(&O::active,
          "active",
          "Which unobserved nodes level I of two_level moves: fixed rings, or those that would "
          "lose "
          "the most energy if they were held.")
          .OnResume(ResumeRule::kNoted),
      Row(&O::active_bound,
          "active_bound",
          "The energy that held nodes may lose with active=information, as a share of the energy "
          "of level I.")
          .In(AtLeast(0))
          .OnResume(ResumeRule::kNoted),
      Row(&O::boundary_edges,
          "boundary",
          "Whether two_level keeps or cuts the edges between nodes of level I and the rest.")
          .OnResume(ResumeRule::kNoted),
      Row(&O::linear_solver,
          "linear_solver",
          "block is the library's own solver; pcg solves the same equations by conjugate "
          "gradients, for large graphs; auto chooses by size; ceres is ceres::Solve, the "
          "reference."),
      Row(&O::preconditioner, "preconditioner", "What makes the conjugate gradients converge."),
      Row(&O::relinearize_above,
          "relinearize_above",
          "marginal eliminates a node anew when an entry of its matrix changes by more.")
          .In(AtLeast(0)),
      Row(&O::marginal_reach,
          "marginal_reach",
          "marginal eliminates this many rings of unobserved nodes; the nodes behind them are "
          "held.")
          .In(AtLeast(1))
          .Special(-1, "all"),
  });
  return rows;
}

bool StrategyOptions::IsValid(std::string* error) const { return Rows().Check(*this, error); }

}  // namespace ceres_ed
