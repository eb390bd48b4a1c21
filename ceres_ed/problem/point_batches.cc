#include "ceres_ed/problem/point_batches.h"

#include <algorithm>
#include <cstddef>

namespace ceres_ed {
namespace {

// Returns the batch store of a residual, or null if it has none.
const BatchPointStore* AsBatch(const SelectedResidual& residual) {
  if (residual.store == nullptr) return nullptr;
  if (residual.store->form() != ResidualStore::Form::kPoint) return nullptr;
  return static_cast<const PointStore*>(residual.store)->AsBatch();
}

}  // namespace

void PointBatches::Build(const DeformationGraph& graph,
                         const std::vector<SelectedResidual>& residuals) {
  graph_ = &graph;
  batches_.clear();
  for (const SelectedResidual& residual : residuals) {
    const BatchPointStore* const store = AsBatch(residual);
    if (store == nullptr) continue;
    if (Find(store) == nullptr) {
      batches_.emplace_back();
      batches_.back().store = store;
      batches_.back().row_of_index.assign(store->size(), -1);
    }
    Batch& batch = *std::find_if(
        batches_.begin(), batches_.end(), [&](const Batch& b) { return b.store == store; });
    // The blocks of each residual, by its index until all are known.
    batch.blocks.resize(store->size(), nullptr);
    batch.blocks[residual.index] = residual.blocks;
  }
  for (Batch& batch : batches_) {
    std::vector<const BlockRef*> blocks;
    for (int i = 0; i < batch.store->size(); ++i) {
      if (batch.blocks[i] == nullptr) continue;
      batch.row_of_index[i] = static_cast<int>(batch.indices.size());
      batch.indices.push_back(i);
      blocks.push_back(batch.blocks[i]);
    }
    batch.blocks = std::move(blocks);
    const std::size_t values = batch.indices.size() * batch.store->num_residuals();
    batch.residuals.resize(values);
    batch.jacobians.resize(3 * values);
  }
}

bool PointBatches::Evaluate(const DeformationState& state) {
  for (Batch& batch : batches_) {
    if (!batch.store->EvaluateAll(static_cast<int>(batch.indices.size()),
                                  batch.indices.data(),
                                  batch.blocks.data(),
                                  *graph_,
                                  state,
                                  batch.residuals.data(),
                                  batch.jacobians.data())) {
      return false;
    }
  }
  return true;
}

const PointBatches::Batch* PointBatches::Find(const ResidualStore* store) const {
  for (const Batch& batch : batches_) {
    if (batch.store == store) return &batch;
  }
  return nullptr;
}

const double* PointBatches::Residuals(const ResidualStore* store, int index) const {
  const Batch* const batch = Find(store);
  if (batch == nullptr) return nullptr;
  return &batch->residuals[std::size_t{1} * batch->row_of_index[index] * store->num_residuals()];
}

const double* PointBatches::Jacobian(const ResidualStore* store, int index) const {
  const Batch* const batch = Find(store);
  if (batch == nullptr) return nullptr;
  return &batch->jacobians[std::size_t{3} * batch->row_of_index[index] * store->num_residuals()];
}

}  // namespace ceres_ed
