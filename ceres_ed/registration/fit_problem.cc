#include "ceres_ed/registration/fit_problem.h"

#include <algorithm>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// Point-to-point uses every kThinning-th correspondence.
constexpr int kThinning = 4;

// On the last graph, the edges through a body keep its nodes from shearing. E_rot then has this
// part of its weight, so that a strain reaches through the body instead of fading behind the
// surface that is seen.
constexpr double kBodyRotation = 0.1;

// The rules of a fit's energies. Each energy is a mean over its residuals.
struct FitRules {
  FitRules(const BuiltGraph& graph, bool is_last) {
    rotation.scale = WeightScale::kPerResidual;
    rotation.stiff = true;
    regularization = rotation;
    const double spacing = graph.node_spacing;
    regularization.unit = spacing > 0.0 ? 1.0 / (spacing * spacing) : 1.0;
    if (graph.graph.num_edges() > graph.num_surface_edges) {
      // The weights are those of the mean over the surface, to which the body adds its part.
      rotation.unit *= static_cast<double>(graph.graph.num_nodes()) /
                       std::max(1, graph.graph.num_surface_nodes());
      regularization.unit *=
          static_cast<double>(graph.graph.num_edges()) / std::max(1, graph.num_surface_edges);
      if (is_last) rotation.unit *= kBodyRotation;
    }
    // The weights of matched pairs are relative areas, whose sum is one.
    data.unit = kPerSquaredLength;
    data.matched = true;
    data.loss_width = LossWidth::kCorrespondences;
    // Point-to-point keeps the surface from sliding along itself, for which few pairs are enough.
    few_data = data;
    few_data.thinned = true;
    landmark.unit = kPerSquaredLength;
    landmark.scale = WeightScale::kPerResidual;
    fixed = landmark;
    fixed.pairs = PairSource::kPinned;
  }

  TermRule rotation;
  TermRule regularization;
  TermRule data;
  TermRule few_data;
  TermRule landmark;
  TermRule fixed;
};

}  // namespace

TermRule RuleOfUser(EnergyKind kind) {
  TermRule rule;
  rule.is_users = true;
  if (kind == EnergyKind::kObservation) {
    rule.unit = kPerSquaredLength;
    rule.matched = true;
  } else {
    rule.scale = WeightScale::kPerResidual;
  }
  return rule;
}

StatusOr<std::unique_ptr<FitProblem>> FitProblem::Create(const UnitFit& fit,
                                                         const BuiltGraph& graph,
                                                         bool is_last) {
  auto problem = std::make_unique<FitProblem>(graph, fit.source->cloud(), is_last);
  Status status = problem->AddEnergies(*fit.options, *fit.registry, fit.landmarks, fit.fixed);
  if (!status.ok()) return status;
  return problem;
}

FitProblem::FitProblem(const BuiltGraph& graph, const PointCloud& source, bool is_last)
    : graph_(graph),
      source_(source),
      is_last_(is_last),
      builder_(graph.graph, /*has_camera=*/false) {}

TermInputs FitProblem::Inputs() const {
  TermInputs inputs;
  inputs.context.graph = &graph_.graph;
  inputs.context.points = &source_.points;
  if (source_.HasNormals()) inputs.context.normals = &source_.normals;
  if (source_.HasTriangles()) inputs.context.triangles = &source_.triangles;
  inputs.context.skinning = &graph_.skinning;
  inputs.context.correspondences = &correspondences_;
  inputs.context.match_details = &details_;
  inputs.context.landmarks = &landmarks_;
  inputs.thinned = &thinned_;
  inputs.pinned = &fixed_;
  inputs.stiffness = stiffness_;
  inputs.correspondence_width = loss_width_;
  return inputs;
}

Status FitProblem::AddEnergies(const FitOptions& options,
                               const EnergyRegistry& registry,
                               const std::vector<Correspondence>& landmarks,
                               const std::vector<Correspondence>& fixed) {
  landmarks_ = landmarks;
  fixed_ = fixed;
  const FitRules rules(graph_, is_last_);
  const FitWeights& weights = options.weights;
  const double point_weight = weights.data * weights.point_to_point_share;
  const double plane_weight = weights.data - point_weight;
  const LossSpec loss = {options.loss, loss_width_};
  std::vector<TermSpec> specs = {
      {"rotation", {"rotation", weights.rotation, {}, {}}, rules.rotation},
      {"regularization", {"regularization", weights.regularization, {}, {}}, rules.regularization},
      {"point_to_plane", {"point_to_plane", plane_weight, loss, {}}, rules.data},
      {"point_to_point", {"point_to_point", point_weight, loss, {}}, rules.few_data}};
  if (!landmarks.empty()) {
    specs.push_back({"landmark", {"landmark", weights.landmark, {}, {}}, rules.landmark});
  }
  if (!fixed.empty()) {
    specs.push_back({"fixed", {"landmark", weights.fixed, {}, {}}, rules.fixed});
  }
  for (const EnergySpec& spec : options.extra_energies) {
    const EnergyInfo* const info = registry.Find(spec.name);
    const EnergyKind kind = info != nullptr ? info->kind : EnergyKind::kPrior;
    specs.push_back({spec.name, spec, RuleOfUser(kind)});
  }
  for (const TermSpec& spec : specs) {
    if (Status status = terms_.Add(registry, spec); !status.ok()) return status;
  }
  terms_.AddTo(Inputs(), TermLevels::kLevelOne, &builder_);
  return Status::Ok();
}

void FitProblem::SetStiffness(double stiffness) {
  stiffness_ = stiffness;
  terms_.Weigh(Inputs(), &builder_);
}

void FitProblem::SetWeights(const std::vector<double>& weights) {
  CHECK_EQ(static_cast<int>(weights.size()), builder_.num_terms());
  for (int term = 0; term < builder_.num_terms(); ++term) builder_.SetWeight(term, weights[term]);
}

void FitProblem::SetMatches(const Matches& matches, double loss_width) {
  correspondences_ = matches.correspondences;
  details_ = matches.details;
  loss_width_ = loss_width;
  thinned_.clear();
  thinned_.reserve(correspondences_.size() / kThinning + 1);
  for (std::size_t i = 0; i < correspondences_.size(); i += kThinning) {
    thinned_.push_back(correspondences_[i]);
    thinned_.back().weight *= kThinning;
  }
  terms_.CollectMatched(Inputs(), &builder_);
}

}  // namespace ceres_ed
