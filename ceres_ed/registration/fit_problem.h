// The objective of a fit: its energies, and how their weights are brought to common terms.
#ifndef CERES_ED_REGISTRATION_FIT_PROBLEM_H_
#define CERES_ED_REGISTRATION_FIT_PROBLEM_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/registration/fit.h>

#include <memory>
#include <string>
#include <vector>

namespace ceres_ed {

// Energies of a fit over one graph, in a frame where the source's diagonal is 1. The graph, points
// and skinning that are passed in must outlive it.
class FitProblem {
 public:
  FitProblem(const BuiltGraph& graph, const std::vector<Eigen::Vector3d>& points);

  // Adds all energies that `options` ask for. `landmarks` and `fixed` are in the unit frame. Error:
  // an unknown energy or parameter.
  Status AddEnergies(const FitOptions& options,
                     const EnergyRegistry& registry,
                     std::vector<Correspondence> landmarks,
                     std::vector<Correspondence> fixed);

  // Multiplies the weights of E_rot and E_reg.
  void SetStiffness(double stiffness);

  // Replaces what was matched; `loss_width` is in the unit frame.
  void SetCorrespondences(std::vector<Correspondence> correspondences, double loss_width);

  const ProblemBuilder& builder() const { return builder_; }

 private:
  // What a weight is divided by, once the residuals are there.
  enum class Normalization {
    // Correspondence weights sum to one already.
    kNone,
    kPerResidual,
  };
  struct Term {
    std::unique_ptr<EnergyTerm> energy;
    int index = -1;
    double weight = 0.0;
    Normalization normalization = Normalization::kNone;
    bool stiff = false;
    bool matched = false;
  };

  Status AddTerm(const EnergyRegistry& registry,
                 const EnergySpec& spec,
                 double unit,
                 const std::vector<Correspondence>& landmarks,
                 Term term);
  EnergyContext Context(const std::vector<Correspondence>& landmarks) const;
  void Collect(const Term& term, const std::vector<Correspondence>& landmarks);
  void ApplyWeight(const Term& term);

  const BuiltGraph& graph_;
  const std::vector<Eigen::Vector3d>& points_;
  ProblemBuilder builder_;
  std::vector<Term> terms_;
  std::vector<Correspondence> correspondences_;
  std::vector<Correspondence> landmarks_;
  LossType loss_ = LossType::kSquared;
  double stiffness_ = 1.0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FIT_PROBLEM_H_
