// The objective of a fit: its energies, and how their weights are brought to common terms.
#ifndef CERES_ED_REGISTRATION_FIT_PROBLEM_H_
#define CERES_ED_REGISTRATION_FIT_PROBLEM_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/registration/fit_types.h>

#include <memory>
#include <string>
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
  std::vector<int> MeasuredTerms() const;

 private:
  // How a term of the fit is weighed.
  struct TermRule {
    // Multiplies the user's weight.
    double unit = 1.0;
    // Divide by the number of residual blocks.
    bool per_residual = false;
    // Multiply by the stiffness.
    bool stiff = false;
    // Collect anew when the correspondences change.
    bool matched = false;
    // Collect a part of the correspondences alone, with their weights raised.
    bool thinned = false;
    // Give the data loss, with the width that SetMatches asks for.
    bool adaptive_loss = false;
  };
  struct Term {
    std::unique_ptr<EnergyTerm> energy;
    TermRule rule;
    int index = -1;
    double weight = 0.0;
  };

  Status AddTerm(const EnergyRegistry& registry,
                 const std::string& label,
                 const EnergySpec& spec,
                 const std::vector<Correspondence>& landmarks,
                 const TermRule& rule);
  EnergyContext Context(const Term& term, const std::vector<Correspondence>& landmarks) const;
  void Collect(const Term& term, const std::vector<Correspondence>& landmarks);
  void ApplyWeight(const Term& term);

  const BuiltGraph& graph_;
  const PointCloud& source_;
  ProblemBuilder builder_;
  std::vector<Term> terms_;
  std::vector<Correspondence> correspondences_;
  std::vector<Correspondence> thinned_;
  std::vector<MatchDetail> details_;
  std::vector<Correspondence> landmarks_;
  LossType loss_ = LossType::kSquared;
  double stiffness_ = 1.0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FIT_PROBLEM_H_
