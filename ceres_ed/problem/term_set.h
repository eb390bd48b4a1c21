// The terms of an objective: energies by name, each with the rule by which it takes part.
#ifndef CERES_ED_PROBLEM_TERM_SET_H_
#define CERES_ED_PROBLEM_TERM_SET_H_

#include <ceres_ed/energy/energy.h>
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/energy/energy_spec.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/util/status.h>

#include <memory>
#include <string>
#include <vector>

namespace ceres_ed {

// What the weight of a term is scaled by.
enum class WeightScale {
  kNone,
  // It is divided by the number of residual blocks, so that the energy is their mean.
  kPerResidual,
  // It is multiplied by TermInputs::nodes_per_observation, so that observations count per observed
  // node, however densely they lie.
  kPerObservedNode,
};

// Where the width of a term's loss comes from. The type of the loss is always the term's own.
enum class LossWidth {
  kOwn,
  // From TermInputs: it follows how far the correspondences, or the features, spread.
  kCorrespondences,
  kFeatures,
};

// Which levels of a problem have residuals of a term.
enum class TermLevels {
  kAll,
  // Level I alone: the hidden nodes of Level II are held by the other terms.
  kLevelOne,
};

// Which pairs an energy sees that asks for EnergyContext::landmarks.
enum class PairSource {
  // The landmarks of the user.
  kLandmarks,
  // TermInputs::pinned.
  kPinned,
  // TermInputs::features.
  kFeatures,
};

// How a term takes part in a problem, as data: no code asks for a term by its name.
struct TermRule {
  // Multiplies the user's weight: it converts from the unit of the user to that of the problem.
  double unit = 1.0;
  WeightScale scale = WeightScale::kNone;
  // Whether the weight is multiplied by TermInputs::stiffness.
  bool stiff = false;
  TermLevels levels = TermLevels::kAll;
  LossWidth loss_width = LossWidth::kOwn;
  // Whether the residuals change with the correspondences and have to be collected anew.
  bool matched = false;
  // Whether the term sees TermInputs::thinned in place of all correspondences.
  bool thinned = false;
  PairSource pairs = PairSource::kLandmarks;
  // Whether a user has asked for the term, who is told if it never adds a residual.
  bool is_users = false;
};

// The description of a term.
struct TermSpec {
  // Names the term in summaries.
  std::string label;
  EnergySpec energy;
  TermRule rule;
};

// What a problem gives its terms: what energies look at, and the values that rules refer to.
struct TermInputs {
  EnergyContext context;
  // A part of the correspondences, with their weights raised; null: there are none.
  const std::vector<Correspondence>* thinned = nullptr;
  // Points that are held in their places; null: there are none.
  const std::vector<Correspondence>* pinned = nullptr;
  // Corners that are followed from frame to frame; null: there are none.
  const std::vector<Correspondence>* features = nullptr;
  // >= 0.
  double stiffness = 1.0;
  // Observed nodes divided by observations, >= 0.
  double nodes_per_observation = 1.0;
  // Widths of losses, > 0.
  double correspondence_width = 1.0;
  double feature_width = 1.0;
};

// Owns terms, and adds them to problems: the one place where rules are applied. Term i of the set
// is term i of every builder that it is added to.
class TermSet {
 public:
  // Appends a term. Error: an unknown energy or parameter, or a weight or a width of the loss that
  // is out of range.
  Status Add(const EnergyRegistry& registry, const TermSpec& spec);

  int size() const { return static_cast<int>(terms_.size()); }
  const TermSpec& spec(int term) const { return terms_[term].spec; }

  // Adds all terms to `builder`, which has none yet, with their weights and losses, and collects
  // the residuals of those that take part in `level`; the others stay empty.
  void AddTo(const TermInputs& inputs, TermLevels level, ProblemBuilder* builder);

  // Collects anew what changes with the correspondences, and weighs it.
  void CollectMatched(const TermInputs& inputs, ProblemBuilder* builder);

  // Sets the weights and losses of all terms.
  void Weigh(const TermInputs& inputs, ProblemBuilder* builder) const;

  // Labels of the user's terms that have not added a residual to any builder yet.
  std::vector<std::string> IdleEnergies() const;

 private:
  struct Term {
    TermSpec spec;
    // EnergyInfo::origin.
    std::string origin;
    std::unique_ptr<EnergyTerm> energy;
    bool has_added = false;
  };

  void Collect(int index, const TermInputs& inputs, ProblemBuilder* builder);
  void Weigh(int index, const TermInputs& inputs, ProblemBuilder* builder) const;

  std::vector<Term> terms_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_PROBLEM_TERM_SET_H_
