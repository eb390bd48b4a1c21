#include "ceres_ed/problem/problem_builder.h"

#include <ceres_ed/problem/point_batches.h>
#include <ceres_ed/util/describe_throw.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

std::string DescribeBlock(const BlockRef& block) {
  switch (block.kind) {
    case BlockRef::Kind::kNode:
      return "node " + std::to_string(block.node);
    case BlockRef::Kind::kCameraRotation:
      return "the camera's rotation";
    case BlockRef::Kind::kCameraTranslation:
      return "the camera's translation";
  }
  LOG(FATAL) << "unknown block kind";
}

bool IsVariable(const BlockRef& block, const ProblemConfig& config) {
  return block.kind == BlockRef::Kind::kNode ? config.variable_nodes[block.node] != 0
                                             : config.camera_variable;
}

bool IsEliminated(const BlockRef& block, const ProblemConfig& config) {
  return block.kind == BlockRef::Kind::kNode && !config.eliminated_nodes.empty() &&
         config.eliminated_nodes[block.node] != 0;
}

// Returns whether a residual on these blocks is part of the problem. With `cut`, it is left out if
// it crosses the boundary.
bool IsIncluded(const BlockRef* blocks, int num_blocks, bool cut, const ProblemConfig& config) {
  int num_variable = 0;
  for (int i = 0; i < num_blocks; ++i) {
    if (IsEliminated(blocks[i], config)) return false;
    if (IsVariable(blocks[i], config)) ++num_variable;
  }
  return num_variable > 0 && !(cut && num_variable < num_blocks);
}

}  // namespace

// The sink of a term. It checks each residual once, when it is collected, and takes no more after
// the first that does not fit.
class ProblemBuilder::TermSink final : public ResidualSink {
 public:
  TermSink(Term* term, int num_nodes, bool has_camera)
      : term_(term), num_nodes_(num_nodes), has_camera_(has_camera) {}

  void Add(std::unique_ptr<ceres::CostFunction> cost,
           const BlockRef* blocks,
           int num_blocks,
           double weight) override {
    if (cost == nullptr) return Refuse("has no cost function");
    const std::vector<int>& sizes = cost->parameter_block_sizes();
    if (static_cast<int>(sizes.size()) != num_blocks) {
      return Refuse("has " + std::to_string(num_blocks) + " blocks, its cost function takes " +
                    std::to_string(sizes.size()));
    }
    for (int i = 0; i < num_blocks; ++i) {
      if (BlockSize(blocks[i]) == sizes[i]) continue;
      return Refuse("has " + DescribeBlock(blocks[i]) + " as block " + std::to_string(i) +
                    " where its cost function takes " + std::to_string(sizes[i]) + " numbers");
    }
    Append(nullptr, static_cast<int>(term_->costs.size()), blocks, num_blocks, weight);
    term_->costs.push_back(std::move(cost));
  }

  ResidualStore* FindStore(ResidualStoreFactory make) override {
    for (const Term::NamedStore& named : term_->stores) {
      if (named.factory == make) return named.store.get();
    }
    term_->stores.push_back({make, make()});
    return term_->stores.back().store.get();
  }

  void AddStored(const ResidualStore* store,
                 const BlockRef* blocks,
                 int num_blocks,
                 double weight) override {
    Append(store, store->size() - 1, blocks, num_blocks, weight);
  }

 private:
  void Append(const ResidualStore* store,
              int index,
              const BlockRef* blocks,
              int num_blocks,
              double weight) {
    if (!(std::isfinite(weight) && weight >= 0.0)) {
      return Refuse("has weight " + std::to_string(weight) + ", expected finite and >= 0");
    }
    for (int i = 0; i < num_blocks; ++i) {
      if (!IsThere(blocks[i])) {
        return Refuse("is on " + DescribeBlock(blocks[i]) + ", which isn't there (" +
                      std::to_string(num_nodes_) + " nodes, " +
                      (has_camera_ ? "a camera)" : "no camera)"));
      }
      for (int k = 0; k < i; ++k) {
        if (blocks[k].kind == blocks[i].kind && blocks[k].node == blocks[i].node) {
          return Refuse("has " + DescribeBlock(blocks[i]) + " twice");
        }
      }
    }
    const int first_block = static_cast<int>(term_->blocks.size());
    term_->blocks.insert(term_->blocks.end(), blocks, blocks + num_blocks);
    term_->residuals.push_back({store, index, weight, first_block, num_blocks});
  }

  bool IsThere(const BlockRef& block) const {
    if (block.kind != BlockRef::Kind::kNode) return has_camera_;
    return block.node >= 0 && block.node < num_nodes_;
  }

  void Refuse(const std::string& why) {
    if (!term_->status.ok()) return;
    term_->status = Status::Error(DescribeEnergy(term_->label, term_->origin) + ": residual " +
                                  std::to_string(term_->residuals.size()) + " " + why);
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

void ProblemBuilder::SetOrigin(int term, std::string origin) {
  terms_[term].origin = std::move(origin);
}

void ProblemBuilder::CollectResiduals(int term,
                                      const EnergyTerm& energy,
                                      const EnergyContext& context) {
  CHECK_EQ(context.graph, &graph_) << "the context is of another graph";
  CHECK_EQ(context.has_camera, has_camera_);
  Term& target = terms_[term];
  const auto clear = [&target] {
    target.residuals.clear();
    target.blocks.clear();
    target.costs.clear();
    for (const Term::NamedStore& named : target.stores) named.store->Clear();
  };
  clear();
  target.status = Status::Ok();
  TermSink sink(&target, graph_.num_nodes(), has_camera_);
  const std::string reason = DescribeThrow([&] { energy.AddResiduals(context, &sink); });
  if (!reason.empty() && target.status.ok()) {
    target.status =
        Status::Error(DescribeEnergy(target.label, target.origin) + ": after " +
                      std::to_string(target.residuals.size()) + " residuals it " + reason);
  }
  if (!target.status.ok()) clear();
}

Status ProblemBuilder::status() const {
  for (const Term& term : terms_) {
    if (!term.status.ok()) return term.status;
  }
  return Status::Ok();
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

int SelectedResidual::num_residuals() const {
  return store != nullptr ? store->num_residuals() : cost->num_residuals();
}

std::shared_ptr<const ceres::CostFunction> SelectedResidual::CostFunction(
    const DeformationGraph& graph) const {
  if (store != nullptr) return store->MakeCost(index, blocks, graph);
  // The cost function has another owner, so the pointer does not delete it.
  return std::shared_ptr<const ceres::CostFunction>(std::shared_ptr<void>(), cost);
}

SelectedResidual ProblemBuilder::Term::Selected(const Residual& residual) const {
  SelectedResidual selected;
  selected.store = residual.store;
  selected.index = residual.index;
  if (residual.store == nullptr) selected.cost = costs[residual.index].get();
  selected.blocks = &blocks[residual.first_block];
  selected.num_blocks = residual.num_blocks;
  selected.weight = weight * residual.weight;
  return selected;
}

std::vector<SelectedResidual> ProblemBuilder::Select(const ProblemConfig& config) const {
  std::vector<SelectedResidual> selected;
  Select(config, &selected);
  return selected;
}

void ProblemBuilder::Select(const ProblemConfig& config,
                            std::vector<SelectedResidual>* selected) const {
  CheckConfig(config);
  selected->clear();
  for (int t = 0; t < num_terms(); ++t) {
    const Term& term = terms_[t];
    const bool cut =
        term.kind == EnergyKind::kPrior && config.boundary_edges == BoundaryEdges::kCut;
    for (const Residual& residual : term.residuals) {
      const BlockRef* blocks = &term.blocks[residual.first_block];
      if (term.weight * residual.weight == 0.0 ||
          !IsIncluded(blocks, residual.num_blocks, cut, config)) {
        continue;
      }
      selected->push_back(term.Selected(residual));
      selected->back().term = t;
    }
  }
  // The residuals that replace eliminated nodes.
  for (const ExtraResidual& extra : config.extra_residuals) {
    const int num_blocks = static_cast<int>(extra.blocks.size());
    if (!IsIncluded(extra.blocks.data(), num_blocks, /*cut=*/false, config)) continue;
    selected->push_back({extra.cost, nullptr, -1, extra.blocks.data(), num_blocks, -1, 1.0});
  }
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

bool ProblemBuilder::IsBatch(const Term& term) {
  if (term.residuals.empty()) return false;
  const ResidualStore* const store = term.residuals.front().store;
  return store != nullptr && store->form() == ResidualStore::Form::kPoint &&
         static_cast<const PointStore*>(store)->AsBatch() != nullptr;
}

TermEnergy ProblemBuilder::Evaluate(const Term& term, const DeformationState& state) const {
  TermEnergy energy;
  energy.label = term.label;
  const std::unique_ptr<ceres::LossFunction> loss = MakeLoss(term.loss);
  std::vector<const double*> pointers;
  std::vector<double> residuals;
  if (!term.status.ok()) energy.weighted = energy.raw = std::numeric_limits<double>::quiet_NaN();
  PointBatches batches;
  bool batches_valid = true;
  if (IsBatch(term)) {
    std::vector<SelectedResidual> all;
    for (const Residual& residual : term.residuals) all.push_back(term.Selected(residual));
    batches.Build(graph_, all);
    const std::string thrown = DescribeThrow([&] { batches_valid = batches.Evaluate(state); });
    batches_valid = batches_valid && thrown.empty();
  }
  for (const Residual& residual : term.residuals) {
    const BlockRef* blocks = &term.blocks[residual.first_block];
    const SelectedResidual selected = term.Selected(residual);
    residuals.assign(selected.num_residuals(), 0.0);
    bool valid = false;
    const std::string thrown = DescribeThrow([&] {
      if (!batches.empty()) {
        std::copy_n(
            batches.Residuals(residual.store, residual.index), residuals.size(), residuals.begin());
        valid = batches_valid;
        return;
      }
      if (residual.store != nullptr) {
        valid = residual.store->Evaluate(residual.index, blocks, graph_, state, residuals.data());
        return;
      }
      pointers.clear();
      for (int i = 0; i < residual.num_blocks; ++i) {
        pointers.push_back(BlockPointer(state, blocks[i]));
      }
      valid = selected.cost->Evaluate(pointers.data(), residuals.data(), nullptr);
    });
    valid = valid && thrown.empty();
    // Add up weight * rho(|r|^2) / 2 and |r|^2 / 2.
    double squared_norm = valid ? 0.0 : std::numeric_limits<double>::quiet_NaN();
    for (const double r : residuals) squared_norm += r * r;
    double rho[3] = {squared_norm, 1.0, 0.0};
    if (loss != nullptr) loss->Evaluate(squared_norm, rho);
    energy.weighted += 0.5 * selected.weight * rho[0];
    energy.raw += 0.5 * squared_norm;
    energy.residuals += selected.num_residuals();
  }
  return energy;
}

EnergySummary ProblemBuilder::Evaluate(const DeformationState& state) const {
  EnergySummary summary;
  for (const Term& term : terms_) summary.terms.push_back(Evaluate(term, state));
  return summary;
}

}  // namespace ceres_ed
