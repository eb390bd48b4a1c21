// The objective of a fit: its energies, and how their weights are brought to common terms.
#ifndef CERES_ED_REGISTRATION_FIT_PROBLEM_H_
#define CERES_ED_REGISTRATION_FIT_PROBLEM_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/problem/term_set.h>
#include <ceres_ed/registration/fit_types.h>

#include <vector>

namespace ceres_ed {

// Energies of a fit over one graph, in a frame where the source's diagonal is 1. The graph and the
// source that are passed in must outlive it.
class FitProblem {
 public:
  FitProblem(const BuiltGraph& graph, const PointCloud& source);

  // Adds all energies that `options` ask for. `landmarks` and `fixed` are in the unit frame. Error:
  // an unknown energy or parameter.
  Status AddEnergies(const FitOptions& options,
                     const EnergyRegistry& registry,
                     const std::vector<Correspondence>& landmarks,
                     const std::vector<Correspondence>& fixed);

  // Multiplies the weights of E_rot and E_reg.
  void SetStiffness(double stiffness);

  // Replaces what was matched; `loss_width` is in the unit frame.
  void SetMatches(const Matches& matches, double loss_width);

  const ProblemBuilder& builder() const { return builder_; }

  // The terms of what was measured, each measurement once: observations, but for the few pairs that
  // point-to-point sees a second time.
  std::vector<int> MeasuredTerms() const { return terms_.MeasuredTerms(builder_); }

 private:
  TermInputs Inputs() const;

  const BuiltGraph& graph_;
  const PointCloud& source_;
  ProblemBuilder builder_;
  TermSet terms_;
  std::vector<Correspondence> correspondences_;
  std::vector<Correspondence> thinned_;
  std::vector<MatchDetail> details_;
  std::vector<Correspondence> landmarks_;
  std::vector<Correspondence> fixed_;
  double stiffness_ = 1.0;
  double loss_width_ = 1.0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FIT_PROBLEM_H_
