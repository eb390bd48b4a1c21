// The ways to follow the target on the coarse graphs: which are tried, and which go on.
#ifndef CERES_ED_REGISTRATION_HYPOTHESES_PORTFOLIO_H_
#define CERES_ED_REGISTRATION_HYPOTHESES_PORTFOLIO_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/registration/fit_types.h>
#include <ceres_ed/registration/graph_pyramid.h>
#include <ceres_ed/registration/hypotheses/hypothesis.h>
#include <ceres_ed/registration/nonrigid_loop.h>
#include <ceres_ed/registration/unit_fit.h>
#include <ceres_ed/util/status.h>

#include <vector>

namespace ceres_ed {

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

// The attempts of a fit. All arguments must outlive this object.
class Portfolio {
 public:
  // `plans` says what is done on each of `graphs`.
  Portfolio(const UnitFit& fit,
            const GraphPyramid& graphs,
            const std::vector<ResolutionPlan>& plans)
      : fit_(fit), graphs_(graphs), plans_(plans) {}

  // Follows the target on all graphs but the finest one by each hypothesis that is needed
  // (Hypothesis::needed_above). Returns the attempts that were not given up, the best first; there
  // is at least one. Fills in status, iterations, times and the disagreement of the ways. It is an
  // error if an energy is unknown.
  StatusOr<std::vector<Attempt>> Try(FitResult* result) const;

 private:
  // Returns the states of the coarsest graph from which a hypothesis starts; there may be none.
  std::vector<DeformationState> StartsOf(const Hypothesis& hypothesis) const;
  // Follows the target with one attempt, and measures the result. An attempt that cannot reach what
  // the best one leaves to explain is given up.
  Status Follow(double best, Attempt* attempt, FitResult* result) const;
  void Measure(Attempt* attempt) const;
  // Sorts the attempts, and measures how far apart the best careful and the best bold one are.
  void Rank(std::vector<Attempt>* attempts, FitResult* result) const;

  const UnitFit& fit_;
  const GraphPyramid& graphs_;
  const std::vector<ResolutionPlan>& plans_;
};

// Returns the best one of `attempts`, which are sorted, and another one that is near to it and not
// the same warp. There is no other one if the best one leaves nothing of a surface.
std::vector<Attempt> Finalists(std::vector<Attempt> attempts);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_HYPOTHESES_PORTFOLIO_H_
