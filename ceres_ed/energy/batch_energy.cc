#include "ceres_ed/energy/batch_energy.h"

#include <array>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace ceres_ed {
namespace {

Eigen::Vector3d NormalAtRest(const EnergyContext& context, int index) {
  if (context.normals == nullptr || context.normals->empty()) return Eigen::Vector3d::Zero();
  return (*context.normals)[index];
}

// Returns the number of residuals that the function has for the points of `context` at rest.
int AskForNumResiduals(const PointBatchFunction& function, const EnergyContext& context) {
  const int count = static_cast<int>(context.points->size());
  std::vector<int> indices(count);
  std::iota(indices.begin(), indices.end(), 0);
  std::vector<Eigen::Vector3d> normals;
  normals.reserve(count);
  for (int i = 0; i < count; ++i) normals.push_back(NormalAtRest(context, i));
  const int num_residuals = function.NumResiduals(
      {count, indices.data(), context.points->data()->data(), normals.data()->data()});
  if (num_residuals < 1) {
    throw std::invalid_argument("has " + std::to_string(num_residuals) +
                                " residuals a point, expected one or more");
  }
  return num_residuals;
}

}  // namespace

std::unique_ptr<EnergyTerm> ForAllPoints(EnergyKind kind,
                                         const std::shared_ptr<const PointBatchFunction>& function,
                                         PointFrame frame) {
  return MakeEnergy(kind, [function, frame](const EnergyContext& context, ResidualSink* sink) {
    if (context.points->empty()) return;
    const int num_residuals = AskForNumResiduals(*function, context);
    const bool has_camera = context.has_camera && frame == PointFrame::kObserved;
    // A sink that takes only cost functions gets those of a store of its own.
    BatchPointStore own;
    auto* const found = FindStore<BatchPointStore>(sink);
    BatchPointStore* const store = found != nullptr ? found : &own;
    store->SetFunction(function, num_residuals);
    for (int p = 0; p < static_cast<int>(context.points->size()); ++p) {
      const Binding binding = (*context.skinning)[p];
      std::array<BlockRef, kMaxBoundNodes + 2> blocks;
      int num_blocks = 0;
      for (int i = 0; i < binding.size; ++i) {
        blocks[num_blocks++] = BlockRef::Node(binding.nodes[i]);
      }
      if (has_camera) {
        blocks[num_blocks++] = BlockRef::CameraRotation();
        blocks[num_blocks++] = BlockRef::CameraTranslation();
      }
      store->Add((*context.points)[p], NormalAtRest(context, p), p, binding, has_camera);
      if (found != nullptr) {
        sink->AddStored(store, blocks.data(), num_blocks, 1.0);
      } else {
        sink->Add(store->MakeCost(store->size() - 1, blocks.data(), *context.graph),
                  blocks.data(),
                  num_blocks,
                  1.0);
      }
    }
  });
}

}  // namespace ceres_ed
