#include "ceres_ed/testing/residual_collection.h"

#include <cmath>
#include <set>
#include <utility>

namespace ceres_ed {
namespace {

class CollectingSink final : public ResidualSink {
 public:
  void Add(std::unique_ptr<ceres::CostFunction> cost,
           const BlockRef* blocks,
           int num_blocks,
           double weight) override {
    residuals.push_back({std::move(cost), {blocks, blocks + num_blocks}, weight});
  }

  std::vector<CollectedResidual> residuals;
};

int SizeOf(const BlockRef& block) {
  if (block.kind == BlockRef::Kind::kNode) return kNodeSize;
  return block.kind == BlockRef::Kind::kCameraRotation ? kRotationSize : kTranslationSize;
}

}  // namespace

std::vector<CollectedResidual> CollectResiduals(const EnergyTerm& energy,
                                                const EnergyContext& context) {
  CollectingSink sink;
  energy.AddResiduals(context, &sink);
  return std::move(sink.residuals);
}

ParameterBlocks BlocksAt(const CollectedResidual& residual, const DeformationState& state) {
  ParameterBlocks blocks;
  for (const BlockRef& block : residual.blocks) {
    blocks.push_back(CopyBlock(BlockPointer(state, block), SizeOf(block)));
  }
  return blocks;
}

std::string BlockFault(const CollectedResidual& residual, int num_nodes, bool has_camera) {
  if (residual.cost == nullptr) return "there is no cost function";
  if (!(residual.weight >= 0.0 && std::isfinite(residual.weight))) {
    return "its weight is " + std::to_string(residual.weight) + ", expected >= 0";
  }
  if (residual.blocks.empty()) return "it touches neither a node nor the camera";
  const std::vector<int>& sizes = residual.cost->parameter_block_sizes();
  if (sizes.size() != residual.blocks.size()) {
    return "it has " + std::to_string(residual.blocks.size()) + " blocks, its cost function " +
           std::to_string(sizes.size());
  }
  std::set<std::pair<int, int>> seen;
  for (std::size_t b = 0; b < sizes.size(); ++b) {
    const BlockRef& block = residual.blocks[b];
    const std::string name = "block " + std::to_string(b);
    if (block.kind == BlockRef::Kind::kNode) {
      if (block.node < 0 || block.node >= num_nodes) {
        return name + " is node " + std::to_string(block.node) + " of " + std::to_string(num_nodes);
      }
    } else if (!has_camera) {
      return name + " is a camera that isn't there";
    }
    if (SizeOf(block) != sizes[b]) {
      return name + " has size " + std::to_string(sizes[b]) + ", expected " +
             std::to_string(SizeOf(block));
    }
    if (!seen.insert({static_cast<int>(block.kind), block.node}).second) {
      return name + " is there twice";
    }
  }
  return "";
}

}  // namespace ceres_ed
