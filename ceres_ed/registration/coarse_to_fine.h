// The resolutions of a fit, from few nodes to many.
#ifndef CERES_ED_REGISTRATION_COARSE_TO_FINE_H_
#define CERES_ED_REGISTRATION_COARSE_TO_FINE_H_

#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/fit_types.h>
#include <ceres_ed/registration/hypotheses/hypothesis.h>
#include <ceres_ed/registration/nonrigid_loop.h>
#include <ceres_ed/registration/unit_fit.h>

#include <utility>
#include <vector>

namespace ceres_ed {

// Runs the resolutions one after the other and transfers the warp from graph to graph. The coarse
// graphs are fitted by each hypothesis in turn (hypotheses/hypothesis.h), and the fit continues
// with the state that leaves least to explain (hypotheses/explanation.h).
class CoarseToFine {
 public:
  explicit CoarseToFine(UnitFit fit) : fit_(std::move(fit)) {}

  // Fills in status, energies, matches, iterations, times and warnings of `result`. It is an error
  // if no graph can be built on the source, or if an energy is unknown.
  Status Run(FitResult* result);

  // Return the graph and the state at the end of the fit.
  const BuiltGraph& graph() const { return graphs_[graph_]; }
  const DeformationState& state() const { return state_; }

 private:
  // What a hypothesis has come to.
  struct Attempt {
    Hypothesis hypothesis;
    // The graph that it has reached, and the state of its nodes.
    int graph = 0;
    DeformationState state;
    // Whether it has come to its end; otherwise it fell behind the best one.
    bool is_whole = false;
    // What it leaves to explain, and the unmatched share of the surface that is explained better,
    // beyond what noise leaves.
    double left = 0.0;
    double unmatched = 0.0;
    // The unmatched share of the other surface, with the area that is squeezed away.
    double worse = 0.0;
    // Whether nothing of that surface is left, and whether much of the other one is.
    bool is_explained = false;
    bool is_partial = false;
    // The part of the progress on coarse graphs that is reached with it.
    double progress = 1.0;
  };

  Status BuildGraphs(int resolutions, FitResult* result);
  // Returns the state of the nodes of `resolution` under the warp of `graph`.
  DeformationState CarryOver(const BuiltGraph& graph,
                             const DeformationState& state,
                             int resolution) const;
  // Runs one resolution as `plan` says, from `state`.
  Status RunResolution(int resolution,
                       const ResolutionPlan& plan,
                       DeformationState* state,
                       FitResult* result) const;
  // Returns the states of the coarsest graph from which a hypothesis starts; there may be none.
  std::vector<DeformationState> StartsOf(const Hypothesis& hypothesis) const;
  // Follows the target on all graphs but the finest one, and measures the result. An attempt that
  // cannot reach what the best one leaves to explain is given up.
  Status FollowCoarse(double best, Attempt* attempt, FitResult* result) const;
  // Tries the hypotheses that are needed; the attempts are sorted, the best first.
  Status TryHypotheses(std::vector<Attempt>* attempts, FitResult* result) const;
  // Keeps the best attempt, and another one that is near to it and not the same warp.
  void KeepFinalists(std::vector<Attempt>* attempts) const;
  // Follows the target on the finest graph from each of `attempts`, and keeps the best.
  Status FollowFine(std::vector<Attempt> attempts, FitResult* result);
  // Makes the state of `attempt` that of the fit.
  void Take(Attempt attempt, FitResult* result);
  int LastGraph() const { return static_cast<int>(graphs_.size()) - 1; }
  // Returns to the rigid placement, with a warning, if the deformation explains less of the
  // surfaces. With energies of the user, which may ask for something else, it must explain clearly
  // less.
  void KeepTheBetter(FitResult* result);
  UnitFit fit_;
  // The graphs from coarse to fine.
  std::vector<BuiltGraph> graphs_;
  // What is done on each of them.
  std::vector<ResolutionPlan> plans_;
  int graph_ = 0;
  DeformationState state_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_COARSE_TO_FINE_H_
