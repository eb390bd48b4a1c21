#include "ceres_ed/registration/fit_problem.h"

#include <algorithm>
#include <utility>

namespace ceres_ed {
namespace {

// Distances count in hundredths of the source's diagonal.
constexpr double kPerSquaredLength = 1e4;
// Of the correspondences that point-to-point sees.
constexpr int kThinning = 4;

}  // namespace

FitProblem::FitProblem(const BuiltGraph& graph, const PointCloud& source)
    : graph_(graph), source_(source), builder_(graph.graph, /*has_camera=*/false) {}

EnergyContext FitProblem::Context(const Term& term,
                                  const std::vector<Correspondence>& landmarks) const {
  EnergyContext context;
  context.graph = &graph_.graph;
  context.points = &source_.points;
  if (source_.HasTriangles()) context.triangles = &source_.triangles;
  context.skinning = &graph_.skinning;
  context.correspondences = term.rule.thinned ? &thinned_ : &correspondences_;
  context.match_details = &details_;
  context.landmarks = &landmarks;
  return context;
}

void FitProblem::Collect(const Term& term, const std::vector<Correspondence>& landmarks) {
  builder_.CollectResiduals(term.index, *term.energy, Context(term, landmarks));
}

void FitProblem::ApplyWeight(const Term& term) {
  double weight = term.weight * (term.rule.stiff ? stiffness_ : 1.0);
  if (term.rule.per_residual) {
    weight /= std::max(1, builder_.NumResidualBlocks(term.index));
  }
  builder_.SetWeight(term.index, weight);
}

Status FitProblem::AddTerm(const EnergyRegistry& registry,
                           const std::string& label,
                           const EnergySpec& spec,
                           const std::vector<Correspondence>& landmarks,
                           const TermRule& rule) {
  StatusOr<std::unique_ptr<EnergyTerm>> energy = registry.Create(spec.name, spec.parameters);
  if (!energy.ok()) return energy.status();
  Term term;
  term.energy = *std::move(energy);
  term.rule = rule;
  term.weight = spec.weight * rule.unit;
  term.index = builder_.AddTerm(label, term.energy->kind(), 0.0, spec.loss);
  builder_.SetOrigin(term.index, registry.Find(spec.name)->origin);
  Collect(term, landmarks);
  ApplyWeight(term);
  terms_.push_back(std::move(term));
  return Status::Ok();
}

Status FitProblem::AddEnergies(const FitOptions& options,
                               const EnergyRegistry& registry,
                               const std::vector<Correspondence>& landmarks,
                               const std::vector<Correspondence>& fixed) {
  loss_ = options.loss;
  landmarks_ = landmarks;
  const double spacing = graph_.node_spacing;
  TermRule rotation{1.0};
  rotation.per_residual = true;
  rotation.stiff = true;
  TermRule regularization = rotation;
  regularization.unit = spacing > 0.0 ? 1.0 / (spacing * spacing) : 1.0;
  // The weights of matched pairs are relative areas and sum to one.
  TermRule data{kPerSquaredLength};
  data.matched = true;
  data.adaptive_loss = true;
  // Holds the surface along itself, which takes no more than a few.
  TermRule few_data = data;
  few_data.thinned = true;
  TermRule given{kPerSquaredLength};
  given.per_residual = true;

  const FitWeights& weights = options.weights;
  const double point_weight = weights.data * weights.point_to_point_share;
  struct Planned {
    std::string label;
    EnergySpec spec;
    const std::vector<Correspondence>* landmarks;
    TermRule rule;
  };
  std::vector<Planned> planned = {
      {"rotation", {"rotation", weights.rotation, {}, {}}, &landmarks_, rotation},
      {"regularization",
       {"regularization", weights.regularization, {}, {}},
       &landmarks_,
       regularization},
      {"point_to_plane",
       {"point_to_plane", weights.data - point_weight, {}, {}},
       &landmarks_,
       data},
      {"point_to_point", {"point_to_point", point_weight, {}, {}}, &landmarks_, few_data}};
  if (!landmarks.empty()) {
    planned.push_back({"landmark", {"landmark", weights.landmark, {}, {}}, &landmarks_, given});
  }
  if (!fixed.empty()) {
    planned.push_back({"fixed", {"landmark", weights.fixed, {}, {}}, &fixed, given});
  }
  for (const EnergySpec& spec : options.extra_energies) {
    const EnergyInfo* info = registry.Find(spec.name);
    TermRule rule{1.0};
    if (info != nullptr && info->kind == EnergyKind::kObservation) {
      rule.unit = kPerSquaredLength;
      rule.matched = true;
    } else {
      rule.per_residual = true;
    }
    planned.push_back({spec.name, spec, &landmarks_, rule});
  }
  for (const Planned& plan : planned) {
    Status status = AddTerm(registry, plan.label, plan.spec, *plan.landmarks, plan.rule);
    if (!status.ok()) return status;
  }
  return Status::Ok();
}

std::vector<int> FitProblem::MeasuredTerms() const {
  const auto is_active = [&](const Term& term) {
    return builder_.weight(term.index) > 0.0 && builder_.NumResidualBlocks(term.index) > 0;
  };
  bool seen_whole = false;
  for (const Term& term : terms_) {
    if (term.rule.adaptive_loss && !term.rule.thinned && is_active(term)) seen_whole = true;
  }
  std::vector<int> measured;
  for (const Term& term : terms_) {
    if (term.energy->kind() != EnergyKind::kObservation || !is_active(term)) continue;
    if (!term.rule.thinned || !seen_whole) measured.push_back(term.index);
  }
  return measured;
}

void FitProblem::SetStiffness(double stiffness) {
  stiffness_ = stiffness;
  for (const Term& term : terms_) {
    if (term.rule.stiff) ApplyWeight(term);
  }
}

void FitProblem::SetMatches(const Matches& matches, double loss_width) {
  correspondences_ = matches.correspondences;
  details_ = matches.details;
  thinned_.clear();
  for (std::size_t i = 0; i < correspondences_.size(); i += kThinning) {
    thinned_.push_back(correspondences_[i]);
    thinned_.back().weight *= kThinning;
  }
  for (const Term& term : terms_) {
    if (!term.rule.matched) continue;
    if (term.rule.adaptive_loss) builder_.SetLoss(term.index, {loss_, loss_width});
    Collect(term, landmarks_);
  }
}

}  // namespace ceres_ed
