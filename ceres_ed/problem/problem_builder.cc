#include "ceres_ed/problem/problem_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <ceres/manifold.h>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

int BlockSize(const BlockRef& block) {
  switch (block.kind) {
    case BlockRef::Kind::kNode:
      return kNodeSize;
    case BlockRef::Kind::kCameraRotation:
      return kRotationSize;
    case BlockRef::Kind::kCameraTranslation:
      return kTranslationSize;
  }
  LOG(FATAL) << "unknown block kind";
}

void AddCamera(const ProblemConfig& config, DeformationState* state, BuiltProblem* built) {
  double* rotation = state->camera_from_map.rotation.coeffs().data();
  double* translation = state->camera_from_map.translation.data();
  if (built->problem->HasParameterBlock(rotation)) {
    built->rotation_manifold = std::make_unique<ceres::EigenQuaternionManifold>();
    built->problem->SetManifold(rotation, built->rotation_manifold.get());
    if (!config.camera_variable) built->problem->SetParameterBlockConstant(rotation);
  }
  if (built->problem->HasParameterBlock(translation) && !config.camera_variable) {
    built->problem->SetParameterBlockConstant(translation);
  }
}

double* MutableBlockPointer(DeformationState* state, const BlockRef& block) {
  return const_cast<double*>(BlockPointer(*state, block));
}

bool IsVariable(const BlockRef& block, const ProblemConfig& config) {
  return block.kind == BlockRef::Kind::kNode ? config.variable_nodes[block.node] != 0
                                             : config.camera_variable;
}

bool IsEliminated(const BlockRef& block, const ProblemConfig& config) {
  return block.kind == BlockRef::Kind::kNode && !config.eliminated_nodes.empty() &&
         config.eliminated_nodes[block.node] != 0;
}

// Whether a residual on these blocks is part of the problem; `cut` leaves it out where it crosses
// the seam.
bool IsIncluded(const BlockRef* blocks, int num_blocks, bool cut, const ProblemConfig& config) {
  int num_variable = 0;
  for (int i = 0; i < num_blocks; ++i) {
    if (IsEliminated(blocks[i], config)) return false;
    if (IsVariable(blocks[i], config)) ++num_variable;
  }
  return num_variable > 0 && !(cut && num_variable < num_blocks);
}

ceres::Problem::Options ProblemOptions() {
  ceres::Problem::Options options;
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  // Sizes and aliasing are checked once, by the sink.
  options.disable_all_safety_checks = true;
  return options;
}

}  // namespace

// Checks each residual once, when it is collected.
class ProblemBuilder::TermSink final : public ResidualSink {
 public:
  TermSink(Term* term, int num_nodes, bool has_camera)
      : term_(term), num_nodes_(num_nodes), has_camera_(has_camera) {}

  void Add(std::unique_ptr<ceres::CostFunction> cost,
           const BlockRef* blocks,
           int num_blocks,
           double weight) override {
    CHECK(cost != nullptr) << "energy '" << term_->label << "' added no cost function";
    CHECK(std::isfinite(weight) && weight >= 0.0)
        << "energy '" << term_->label << "': residual weight " << weight;
    const std::vector<int>& sizes = cost->parameter_block_sizes();
    CHECK_EQ(static_cast<int>(sizes.size()), num_blocks) << "energy '" << term_->label << "'";
    for (int i = 0; i < num_blocks; ++i) {
      CheckBlock(blocks[i], sizes[i]);
      for (int k = 0; k < i; ++k) {
        CHECK(blocks[k].kind != blocks[i].kind || blocks[k].node != blocks[i].node)
            << "energy '" << term_->label << "': blocks " << k << " and " << i << " are the same";
      }
    }
    const int first_block = static_cast<int>(term_->blocks.size());
    term_->blocks.insert(term_->blocks.end(), blocks, blocks + num_blocks);
    term_->residuals.push_back({std::move(cost), weight, first_block, num_blocks});
  }

 private:
  void CheckBlock(const BlockRef& block, int size) const {
    CHECK_EQ(BlockSize(block), size) << "energy '" << term_->label << "': block size";
    if (block.kind == BlockRef::Kind::kNode) {
      CHECK(block.node >= 0 && block.node < num_nodes_)
          << "energy '" << term_->label << "': node " << block.node << " of " << num_nodes_;
    } else {
      CHECK(has_camera_) << "energy '" << term_->label << "' uses a camera that isn't there";
    }
  }

  Term* term_;
  int num_nodes_;
  bool has_camera_;
};

double EnergySummary::Total() const {
  double total = 0.0;
  for (const TermEnergy& term : terms) total += term.weighted;
  return total;
}

ProblemBuilder::ProblemBuilder(const DeformationGraph& graph, bool has_camera)
    : graph_(graph), has_camera_(has_camera) {}

ProblemBuilder::~ProblemBuilder() = default;

int ProblemBuilder::AddTerm(std::string label,
                            EnergyKind kind,
                            double weight,
                            const LossSpec& loss) {
  Term term;
  term.label = std::move(label);
  term.kind = kind;
  terms_.push_back(std::move(term));
  const int index = num_terms() - 1;
  SetWeight(index, weight);
  SetLoss(index, loss);
  return index;
}

void ProblemBuilder::CollectResiduals(int term,
                                      const EnergyTerm& energy,
                                      const EnergyContext& context) {
  CHECK_EQ(context.graph, &graph_) << "the context is of another graph";
  CHECK_EQ(context.has_camera, has_camera_);
  Term& target = terms_[term];
  target.residuals.clear();
  target.blocks.clear();
  TermSink sink(&target, graph_.num_nodes(), has_camera_);
  energy.AddResiduals(context, &sink);
}

void ProblemBuilder::SetWeight(int term, double weight) {
  CHECK(std::isfinite(weight) && weight >= 0.0)
      << "energy '" << terms_[term].label << "': weight " << weight;
  terms_[term].weight = weight;
}

void ProblemBuilder::SetLoss(int term, const LossSpec& loss) { terms_[term].loss = loss; }

int ProblemBuilder::NumResidualBlocks(int term) const {
  return static_cast<int>(terms_[term].residuals.size());
}

std::vector<char> ProblemBuilder::PointRelevantNodes() const {
  std::vector<char> relevant(graph_.num_nodes(), 0);
  for (const Term& term : terms_) {
    if (term.kind != EnergyKind::kObservation || term.weight == 0.0) continue;
    for (const Residual& residual : term.residuals) {
      if (residual.weight == 0.0) continue;
      for (int i = 0; i < residual.num_blocks; ++i) {
        const BlockRef& block = term.blocks[residual.first_block + i];
        if (block.kind == BlockRef::Kind::kNode) relevant[block.node] = 1;
      }
    }
  }
  return relevant;
}

std::vector<SelectedResidual> ProblemBuilder::Select(const ProblemConfig& config) const {
  CheckConfig(config);
  std::vector<SelectedResidual> selected;
  for (int t = 0; t < num_terms(); ++t) {
    const Term& term = terms_[t];
    const bool cut = term.kind == EnergyKind::kPrior && config.seam_edges == SeamEdges::kCut;
    for (const Residual& residual : term.residuals) {
      const double weight = term.weight * residual.weight;
      const BlockRef* blocks = &term.blocks[residual.first_block];
      if (weight == 0.0 || !IsIncluded(blocks, residual.num_blocks, cut, config)) continue;
      selected.push_back({residual.cost.get(), blocks, residual.num_blocks, t, weight});
    }
  }
  for (const ExtraResidual& extra : config.extra_residuals) {
    const int num_blocks = static_cast<int>(extra.blocks.size());
    if (!IsIncluded(extra.blocks.data(), num_blocks, /*cut=*/false, config)) continue;
    selected.push_back({extra.cost, extra.blocks.data(), num_blocks, -1, 1.0});
  }
  return selected;
}

void ProblemBuilder::CheckConfig(const ProblemConfig& config) const {
  CHECK_EQ(static_cast<int>(config.variable_nodes.size()), graph_.num_nodes());
  CHECK(has_camera_ || !config.camera_variable) << "there is no camera to vary";
  if (config.eliminated_nodes.empty()) return;
  CHECK_EQ(static_cast<int>(config.eliminated_nodes.size()), graph_.num_nodes());
  for (int j = 0; j < graph_.num_nodes(); ++j) {
    CHECK(config.variable_nodes[j] == 0 || config.eliminated_nodes[j] == 0)
        << "node " << j << " is both variable and eliminated";
  }
}

BuiltProblem ProblemBuilder::Build(const ProblemConfig& config, DeformationState* state) const {
  CHECK_EQ(state->num_nodes(), graph_.num_nodes());
  BuiltProblem built;
  built.problem = std::make_unique<ceres::Problem>(ProblemOptions());
  built.camera_variable = config.camera_variable;
  // Residuals of one term and equal weight share a loss.
  std::map<std::pair<int, double>, ceres::LossFunction*> losses;
  const auto loss_for = [&](int term, double weight) -> ceres::LossFunction* {
    if (term < 0) return nullptr;
    ceres::LossFunction*& loss = losses[{term, weight}];
    if (loss == nullptr) {
      built.losses.push_back(std::make_unique<ceres::ScaledLoss>(
          MakeLoss(terms_[term].loss).release(), weight, ceres::TAKE_OWNERSHIP));
      loss = built.losses.back().get();
    }
    return loss;
  };
  std::vector<char> touched_nodes(graph_.num_nodes(), 0);
  std::vector<double*> blocks;
  for (const SelectedResidual& residual : Select(config)) {
    blocks.clear();
    for (int i = 0; i < residual.num_blocks; ++i) {
      const BlockRef& block = residual.blocks[i];
      blocks.push_back(MutableBlockPointer(state, block));
      if (block.kind == BlockRef::Kind::kNode) touched_nodes[block.node] = 1;
    }
    // Ceres evaluates a cost function it doesn't own only through const methods.
    built.problem->AddResidualBlock(const_cast<ceres::CostFunction*>(residual.cost),
                                    loss_for(residual.term, residual.weight),
                                    blocks.data(),
                                    residual.num_blocks);
  }
  for (int j = 0; j < graph_.num_nodes(); ++j) {
    if (touched_nodes[j] == 0) continue;
    if (config.variable_nodes[j] != 0) {
      ++built.num_variable_nodes;
    } else {
      built.problem->SetParameterBlockConstant(state->node(j));
    }
  }
  AddCamera(config, state, &built);
  return built;
}

EnergySummary ProblemBuilder::Evaluate(const DeformationState& state) const {
  EnergySummary summary;
  std::vector<const double*> blocks;
  std::vector<double> residuals;
  for (const Term& term : terms_) {
    TermEnergy energy;
    energy.label = term.label;
    const std::unique_ptr<ceres::LossFunction> loss = MakeLoss(term.loss);
    for (const Residual& residual : term.residuals) {
      blocks.clear();
      for (int i = 0; i < residual.num_blocks; ++i) {
        blocks.push_back(BlockPointer(state, term.blocks[residual.first_block + i]));
      }
      residuals.assign(residual.cost->num_residuals(), 0.0);
      double squared_norm = std::numeric_limits<double>::quiet_NaN();
      if (residual.cost->Evaluate(blocks.data(), residuals.data(), nullptr)) {
        squared_norm = 0.0;
        for (const double r : residuals) squared_norm += r * r;
      }
      double rho[3] = {squared_norm, 1.0, 0.0};
      if (loss != nullptr) loss->Evaluate(squared_norm, rho);
      energy.weighted += 0.5 * term.weight * residual.weight * rho[0];
      energy.raw += 0.5 * squared_norm;
      energy.residuals += residual.cost->num_residuals();
    }
    summary.terms.push_back(std::move(energy));
  }
  return summary;
}

}  // namespace ceres_ed
