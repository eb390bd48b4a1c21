// The objective of a fit: its energies, with weights in common units.
#ifndef CERES_ED_REGISTRATION_FIT_PROBLEM_H_
#define CERES_ED_REGISTRATION_FIT_PROBLEM_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/problem/term_set.h>
#include <ceres_ed/registration/fit_types.h>
#include <ceres_ed/registration/unit_fit.h>
#include <ceres_ed/util/status.h>

#include <memory>
#include <vector>

namespace ceres_ed {

// The unit of distances is a hundredth of the source's diagonal.
inline constexpr double kPerSquaredLength = 1e4;

// Returns the rule of an energy that the user adds.
TermRule RuleOfUser(EnergyKind kind);

// The energies of a fit over one graph, in the unit frame, in which the source has the diagonal 1.
// The graph and the source must outlive this object.
class FitProblem {
 public:
  // Returns the problem of `fit` on `graph` with all its energies. It is an error if an energy or a
  // parameter is unknown.
  static StatusOr<std::unique_ptr<FitProblem>> Create(const UnitFit& fit,
                                                      const BuiltGraph& graph,
                                                      bool is_last);

  // `is_last` says whether `graph` is the finest one of the fit.
  FitProblem(const BuiltGraph& graph, const PointCloud& source, bool is_last);

  // Adds all energies that `options` select. `landmarks` and `fixed` are in the unit frame. It is
  // an error if an energy or a parameter is unknown.
  Status AddEnergies(const FitOptions& options,
                     const EnergyRegistry& registry,
                     const std::vector<Correspondence>& landmarks,
                     const std::vector<Correspondence>& fixed);

  // Multiplies the weights of E_rot and E_reg by `stiffness`.
  void SetStiffness(double stiffness);

  // Replaces the matches; `loss_width` is in the unit frame.
  void SetMatches(const Matches& matches, double loss_width);

  // Sets the weight of each term of the builder, until one of the functions above is called.
  void SetWeights(const std::vector<double>& weights);

  const ProblemBuilder& builder() const { return builder_; }

  // Returns how a term of the builder takes part.
  const TermRule& rule(int term) const { return terms_.spec(term).rule; }

 private:
  TermInputs Inputs() const;

  const BuiltGraph& graph_;
  const PointCloud& source_;
  const bool is_last_;
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
