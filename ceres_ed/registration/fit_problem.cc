#include "ceres_ed/registration/fit_problem.h"

#include <algorithm>
#include <utility>

namespace ceres_ed {
namespace {

// Distances count in hundredths of the source's diagonal.
constexpr double kPerSquaredLength = 1e4;

}  // namespace

FitProblem::FitProblem(const BuiltGraph& graph, const std::vector<Eigen::Vector3d>& points)
    : graph_(graph), points_(points), builder_(graph.graph, /*has_camera=*/false) {}

EnergyContext FitProblem::Context(const std::vector<Correspondence>& landmarks) const {
  EnergyContext context;
  context.graph = &graph_.graph;
  context.points = &points_;
  context.skinning = &graph_.skinning;
  context.correspondences = &correspondences_;
  context.landmarks = &landmarks;
  return context;
}

void FitProblem::Collect(const Term& term, const std::vector<Correspondence>& landmarks) {
  builder_.CollectResiduals(term.index, *term.energy, Context(landmarks));
}

void FitProblem::ApplyWeight(const Term& term) {
  double weight = term.weight * (term.stiff ? stiffness_ : 1.0);
  if (term.normalization == Normalization::kPerResidual) {
    weight /= std::max(1, builder_.NumResidualBlocks(term.index));
  }
  builder_.SetWeight(term.index, weight);
}

Status FitProblem::AddTerm(const EnergyRegistry& registry,
                           const EnergySpec& spec,
                           double unit,
                           const std::vector<Correspondence>& landmarks,
                           Term term) {
  StatusOr<std::unique_ptr<EnergyTerm>> energy = registry.Create(spec.name, spec.parameters);
  if (!energy.ok()) return energy.status();
  term.energy = *std::move(energy);
  term.weight = spec.weight * unit;
  term.index = builder_.AddTerm(spec.name, term.energy->kind(), 0.0, spec.loss);
  Collect(term, landmarks);
  ApplyWeight(term);
  terms_.push_back(std::move(term));
  return Status::Ok();
}

Status FitProblem::AddEnergies(const FitOptions& options,
                               const EnergyRegistry& registry,
                               std::vector<Correspondence> landmarks,
                               std::vector<Correspondence> fixed) {
  const FitWeights& weights = options.weights;
  loss_ = options.loss;
  landmarks_ = std::move(landmarks);
  const double spacing = graph_.node_spacing;
  const double per_squared_spacing = spacing > 0.0 ? 1.0 / (spacing * spacing) : 1.0;
  struct Planned {
    EnergySpec spec;
    double unit;
    const std::vector<Correspondence>* landmarks;
    Normalization normalization;
    bool stiff;
    bool matched;
  };
  std::vector<Planned> planned;
  planned.push_back({{"rotation", weights.rotation, {}, {}},
                     1.0,
                     &landmarks_,
                     Normalization::kPerResidual,
                     true,
                     false});
  planned.push_back({{"regularization", weights.regularization, {}, {}},
                     per_squared_spacing,
                     &landmarks_,
                     Normalization::kPerResidual,
                     true,
                     false});
  const double plane_weight = weights.data * (1.0 - weights.point_to_point_share);
  const double point_weight = weights.data * weights.point_to_point_share;
  planned.push_back({{"point_to_plane", plane_weight, {}, {}},
                     kPerSquaredLength,
                     &landmarks_,
                     Normalization::kNone,
                     false,
                     true});
  planned.push_back({{"point_to_point", point_weight, {}, {}},
                     kPerSquaredLength,
                     &landmarks_,
                     Normalization::kNone,
                     false,
                     true});
  if (!landmarks_.empty()) {
    planned.push_back({{"landmark", weights.landmark, {}, {}},
                       kPerSquaredLength,
                       &landmarks_,
                       Normalization::kPerResidual,
                       false,
                       false});
  }
  if (!fixed.empty()) {
    planned.push_back({{"landmark", weights.fixed, {}, {}},
                       kPerSquaredLength,
                       &fixed,
                       Normalization::kPerResidual,
                       false,
                       false});
  }
  for (const EnergySpec& spec : options.extra_energies) {
    const EnergyInfo* info = registry.Find(spec.name);
    const bool observation = info != nullptr && info->kind == EnergyKind::kObservation;
    planned.push_back({spec,
                       observation ? kPerSquaredLength : 1.0,
                       &landmarks_,
                       observation ? Normalization::kNone : Normalization::kPerResidual,
                       false,
                       observation});
  }
  for (const Planned& plan : planned) {
    Term term;
    term.normalization = plan.normalization;
    term.stiff = plan.stiff;
    term.matched = plan.matched;
    Status status = AddTerm(registry, plan.spec, plan.unit, *plan.landmarks, std::move(term));
    if (!status.ok()) return status;
  }
  return Status::Ok();
}

void FitProblem::SetStiffness(double stiffness) {
  stiffness_ = stiffness;
  for (const Term& term : terms_) {
    if (term.stiff) ApplyWeight(term);
  }
}

void FitProblem::SetCorrespondences(std::vector<Correspondence> correspondences,
                                    double loss_width) {
  correspondences_ = std::move(correspondences);
  for (const Term& term : terms_) {
    if (!term.matched) continue;
    builder_.SetLoss(term.index, {loss_, loss_width});
    Collect(term, landmarks_);
  }
}

}  // namespace ceres_ed
