// The options of a fit: those of ed_fit by the names of its flags, and those that only C++ has.
#include <ceres_ed/energy/energy_spec.h>
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/choices.h>
#include <ceres_ed/python/options.h>
#include <ceres_ed/registration/fit.h>

namespace ceres_ed::python {
namespace {

using O = FitOptions;

constexpr Choice<LinearSolver> kLinearSolvers[] = {{"block", LinearSolver::kBlock},
                                                   {"ceres", LinearSolver::kCeres}};
constexpr Choice<LossType> kLosses[] = {{"squared", LossType::kSquared},
                                        {"huber", LossType::kHuber},
                                        {"cauchy", LossType::kCauchy},
                                        {"tukey", LossType::kTukey},
                                        {"welsch", LossType::kWelsch},
                                        {"geman_mcclure", LossType::kGemanMcClure}};

void AddFlags(OptionsClass<O>* options) {
  options
      ->Add(
          "mode",
          [](O & o) -> auto& { return o.strategy.mode; },
          kModes,
          "'batch': all nodes at once; 'two_level': observed ones first, then the rest; "
          "'marginal': as batch, the rest eliminated.")
      .Add(
          "rings",
          [](O & o) -> auto& { return o.strategy.rings; },
          "two_level, marginal: rings of unobserved nodes that level I moves too, >= 0.")
      .Add(
          "boundary",
          [](O & o) -> auto& { return o.strategy.seam_edges; },
          kBoundaries,
          "two_level: 'keep' or 'cut' edges across the seam of level I.")
      .Add(
          "linear_solver",
          [](O & o) -> auto& { return o.strategy.linear_solver; },
          kLinearSolvers,
          "'block': own block normal equations; 'ceres': ceres::Solve, the reference.")
      .Add(
          "rigid_first",
          [](O & o) -> auto& { return o.rigid_first; },
          "Find a rigid motion before anything bends.")
      .Add(
          "rigid_scale",
          [](O & o) -> auto& { return o.rigid.with_scale; },
          "Let the rigid motion scale, too.")
      .Add(
          "node_spacing",
          [](O & o) -> auto& { return o.graph.node_spacing; },
          "Distance of nodes, source unit, >= 0; 0: automatic.")
      .Add(
          "neighbors",
          [](O & o) -> auto& { return o.graph.neighbors; },
          "Nodes that move a point, 1 to 8.")
      .Add(
          "w_rot",
          [](O & o) -> auto& { return o.weights.rotation; },
          "Weight of E_rot: each node near a rotation, >= 0.")
      .Add(
          "w_reg",
          [](O & o) -> auto& { return o.weights.regularization; },
          "Weight of E_reg: neighbours agree, >= 0.")
      .Add(
          "w_data",
          [](O & o) -> auto& { return o.weights.data; },
          "Weight of the distance to the target, >= 0.")
      .Add(
          "loss",
          [](O & o) -> auto& { return o.loss; },
          kLosses,
          "Of the distance: squared huber cauchy tukey welsch geman_mcclure.")
      .Add(
          "max_distance",
          [](O & o) -> auto& { return o.matching.max_distance; },
          "No match farther than this, target unit, > 0.")
      .Add(
          "max_angle_deg",
          [](O & o) -> auto& { return o.matching.max_angle_deg; },
          "No match whose normals differ by more, degrees.")
      .Add(
          "max_samples",
          [](O & o) -> auto& { return o.max_samples; },
          "Points of each surface that are matched, >= 10.")
      .Add(
          "finish",
          [](O & o) -> auto& { return o.finish; },
          "Move every point onto the target in the end.")
      .Add(
          "covariance", [](O & o) -> auto& { return o.covariance; }, "Work out FitResult.std_dev.")
      .Add(
          "threads",
          [](O & o) -> auto& { return o.num_threads; },
          "Changes the time, not the result, >= 1.")
      .Add(
          "time_limit_s",
          [](O & o) -> auto& { return o.time_limit_s; },
          "Seconds until the best so far is returned, > 0.");
}

void AddOthers(OptionsClass<O>* options) {
  options
      ->Add(
          "w_landmark",
          [](O & o) -> auto& { return o.weights.landmark; },
          "Weight of the landmarks, >= 0.")
      .Add(
          "w_fixed",
          [](O & o) -> auto& { return o.weights.fixed; },
          "Weight of the fixed points, >= 0.")
      .Add(
          "point_to_point_share",
          [](O & o) -> auto& { return o.weights.point_to_point_share; },
          "Share of w_data that goes to point-to-point, in [0, 1].")
      .Add(
          "target_nodes",
          [](O & o) -> auto& { return o.graph.target_nodes; },
          "Nodes wanted where node_spacing is 0, >= 0; 0: automatic.")
      .Add(
          "loss_width",
          [](O & o) -> auto& { return o.loss_width; },
          "Width of the loss in robust standard deviations of the residuals, > 0.")
      .Add(
          "denoise",
          [](O & o) -> auto& { return o.denoise; },
          "Smooth a noisy target before it is followed.")
      .Add(
          "unfold",
          [](O & o) -> auto& { return o.unfold; },
          "Lay faces flat again that the fit folded over.")
      .Add(
          "levels",
          [](O & o) -> auto& { return o.schedule.levels; },
          "Graphs fitted one after the other, each twice as fine, 1 to 5.")
      .Add(
          "initial_stiffness",
          [](O & o) -> auto& { return o.schedule.initial_stiffness; },
          "Factor of w_rot and w_reg at the start, > 0.")
      .Add(
          "final_stiffness",
          [](O & o) -> auto& { return o.schedule.final_stiffness; },
          "Factor of w_rot and w_reg at the end, of a clean target, > 0.")
      .Add(
          "noise_stiffness",
          [](O & o) -> auto& { return o.schedule.noise_stiffness; },
          "How much noise adds to both, >= 0.")
      .Add(
          "coarse_steps",
          [](O & o) -> auto& { return o.schedule.coarse_steps; },
          "Steps of stiffness on the coarser levels, >= 1.")
      .Add(
          "fine_steps",
          [](O & o) -> auto& { return o.schedule.fine_steps; },
          "Steps of stiffness on the last level, >= 1.")
      .Add(
          "max_rounds",
          [](O & o) -> auto& { return o.schedule.max_rounds; },
          "Rounds of matching and solving in a step, >= 1.")
      .Add(
          "tolerance",
          [](O & o) -> auto& { return o.schedule.tolerance; },
          "Mean motion in a round, of the source's diagonal, that counts as standing still, > 0.")
      .Add(
          "solver_iterations",
          [](O & o) -> auto& { return o.schedule.solver_iterations; },
          "Iterations of the solver in a round, >= 1.");
}

}  // namespace

void BindFitOptions(py::module_& module) {
  OptionsClass<O> options(module, "FitOptions", R"(How a fit is done.

Each option is an attribute, and a keyword of this class and of fit(). Those that ed_fit has are
named like its flags.)");
  AddFlags(&options);
  AddOthers(&options);
}

}  // namespace ceres_ed::python
