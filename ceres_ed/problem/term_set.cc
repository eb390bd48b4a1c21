#include "ceres_ed/problem/term_set.h"

#include <ceres_ed/util/option_check.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

Status CheckNumbers(const TermSpec& spec) {
  const EnergySpec& energy = spec.energy;
  // Beyond this, sums of squares would not be finite.
  constexpr double kMostWeight = 1e100;
  std::string error;
  if (RequireOption(energy.weight >= 0.0 && energy.weight <= kMostWeight,
                    "weight",
                    energy.weight,
                    "in [0, 1e100]",
                    &error) &&
      RequireOption(energy.loss.type == LossType::kSquared ||
                        (std::isfinite(energy.loss.width) && energy.loss.width > 0.0),
                    "loss_width",
                    energy.loss.width,
                    "finite and > 0",
                    &error)) {
    return Status::Ok();
  }
  return Status::Error("energy '" + energy.name + "': " + error);
}

// What a term sees of what a problem gives.
EnergyContext ContextOf(const TermRule& rule, const TermInputs& inputs) {
  static const std::vector<Correspondence> kNone;
  EnergyContext context = inputs.context;
  if (rule.thinned) {
    context.correspondences = inputs.thinned != nullptr ? inputs.thinned : &kNone;
  }
  switch (rule.pairs) {
    case PairSource::kLandmarks:
      break;
    case PairSource::kPinned:
      context.landmarks = inputs.pinned != nullptr ? inputs.pinned : &kNone;
      break;
    case PairSource::kFeatures:
      context.landmarks = inputs.features != nullptr ? inputs.features : &kNone;
      break;
  }
  return context;
}

double WeightOf(const TermSpec& spec, const TermInputs& inputs, int num_residuals) {
  const TermRule& rule = spec.rule;
  const double weight = spec.energy.weight * rule.unit * (rule.stiff ? inputs.stiffness : 1.0);
  switch (rule.scale) {
    case WeightScale::kNone:
      return weight;
    case WeightScale::kPerResidual:
      return weight / std::max(1, num_residuals);
    case WeightScale::kPerObservedNode:
      return weight * inputs.nodes_per_observation;
  }
  LOG(FATAL) << "unknown scale of weights";
}

LossSpec LossOf(const TermSpec& spec, const TermInputs& inputs) {
  LossSpec loss = spec.energy.loss;
  switch (spec.rule.loss_width) {
    case LossWidth::kOwn:
      break;
    case LossWidth::kCorrespondences:
      loss.width = inputs.correspondence_width;
      break;
    case LossWidth::kFeatures:
      loss.width = inputs.feature_width;
      break;
  }
  return loss;
}

}  // namespace

Status TermSet::Add(const EnergyRegistry& registry, const TermSpec& spec) {
  if (Status status = CheckNumbers(spec); !status.ok()) return status;
  StatusOr<std::unique_ptr<EnergyTerm>> energy =
      registry.Create(spec.energy.name, spec.energy.parameters);
  if (!energy.ok()) return energy.status();
  Term term;
  term.spec = spec;
  term.origin = registry.Find(spec.energy.name)->origin;
  term.energy = *std::move(energy);
  terms_.push_back(std::move(term));
  return Status::Ok();
}

void TermSet::AddTo(const TermInputs& inputs, TermLevels level, ProblemBuilder* builder) {
  CHECK_EQ(builder->num_terms(), 0);
  for (int i = 0; i < size(); ++i) {
    const Term& term = terms_[i];
    builder->AddTerm(term.spec.label, term.energy->kind());
    builder->SetOrigin(i, term.origin);
    if (level == TermLevels::kLevelOne || term.spec.rule.levels == TermLevels::kAll) {
      Collect(i, inputs, builder);
    }
    Weigh(i, inputs, builder);
  }
}

void TermSet::CollectMatched(const TermInputs& inputs, ProblemBuilder* builder) {
  for (int i = 0; i < size(); ++i) {
    if (!terms_[i].spec.rule.matched) continue;
    Collect(i, inputs, builder);
    Weigh(i, inputs, builder);
  }
}

void TermSet::Weigh(const TermInputs& inputs, ProblemBuilder* builder) const {
  for (int i = 0; i < size(); ++i) Weigh(i, inputs, builder);
}

void TermSet::Collect(int index, const TermInputs& inputs, ProblemBuilder* builder) {
  Term& term = terms_[index];
  builder->CollectResiduals(index, *term.energy, ContextOf(term.spec.rule, inputs));
  term.has_added = term.has_added || builder->NumResidualBlocks(index) > 0;
}

void TermSet::Weigh(int index, const TermInputs& inputs, ProblemBuilder* builder) const {
  const TermSpec& spec = terms_[index].spec;
  builder->SetWeight(index, WeightOf(spec, inputs, builder->NumResidualBlocks(index)));
  builder->SetLoss(index, LossOf(spec, inputs));
}

std::vector<std::string> TermSet::IdleEnergies() const {
  std::vector<std::string> labels;
  for (const Term& term : terms_) {
    if (term.spec.rule.is_users && !term.has_added) labels.push_back(term.spec.label);
  }
  return labels;
}

}  // namespace ceres_ed
