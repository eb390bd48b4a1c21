#include "ceres_ed/solver/normal_equations.h"

#include <ceres_ed/solver/point_linearization.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include <ceres/manifold.h>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr int kRotationTangent = 3;
constexpr int kCameraTangent = 6;

// The quadratic of a residual that touches nothing but nodes, else null.
const QuadraticCost* AsNodeQuadratic(const SelectedResidual& residual) {
  for (int i = 0; i < residual.num_blocks; ++i) {
    if (residual.blocks[i].kind != BlockRef::Kind::kNode) return nullptr;
  }
  return dynamic_cast<const QuadraticCost*>(residual.cost);
}

}  // namespace

// Finds the item on the same warped point, by open addressing.
class NormalEquations::PointTable {
 public:
  explicit PointTable(std::size_t num_residuals) {
    std::size_t size = 16;
    while (size < 2 * num_residuals) size *= 2;
    slots_.assign(size, -1);
  }

  // The item on the point of `residual`; -1 where there is none yet: the next item is noted as it.
  int FindOrAdd(const std::vector<Item>& items,
                const SelectedResidual& residual,
                const PointCostFunction& cost) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = Hash(residual, cost.point()) & mask;; slot = (slot + 1) & mask) {
      const int item = slots_[slot];
      if (item < 0) {
        slots_[slot] = static_cast<int>(items.size());
        return -1;
      }
      if (IsSame(items[item], residual, cost)) return item;
    }
  }

 private:
  static std::size_t Hash(const SelectedResidual& residual, const BoundPoint& point) {
    // Where a point lies relative to its first node tells it from almost all others.
    std::uint64_t bits[2];
    std::memcpy(bits, point.offset(0).data(), sizeof(bits));
    std::uint64_t hash = bits[0] ^ (bits[1] * 0x9e3779b97f4a7c15ULL) ^
                         static_cast<std::uint64_t>(residual.blocks[0].node);
    hash = (hash ^ (hash >> 32)) * 0xd6e8feb86659fd93ULL;
    return static_cast<std::size_t>(hash ^ (hash >> 32));
  }

  static bool IsSame(const Item& item,
                     const SelectedResidual& residual,
                     const PointCostFunction& cost) {
    const BoundPoint& a = item.point->point();
    const BoundPoint& b = cost.point();
    if (item.point->has_camera() != cost.has_camera() || a.num_nodes() != b.num_nodes()) {
      return false;
    }
    for (int i = 0; i < a.num_nodes(); ++i) {
      if (item.residual.blocks[i].node != residual.blocks[i].node || a.weight(i) != b.weight(i) ||
          a.offset(i) != b.offset(i)) {
        return false;
      }
    }
    return true;
  }

  std::vector<int> slots_;
};

int NormalEquations::Item::LinearizationSize() const {
  if (point != nullptr) return PointLinearization::kNumDoubles;
  if (quadratic != nullptr) return quadratic->size();
  return num_residuals * (1 + width);
}

NormalEquations::NormalEquations(const ProblemBuilder& builder, const ProblemConfig& config) {
  const std::vector<SelectedResidual> selected = builder.Select(config);
  std::vector<char> touched(config.variable_nodes.size(), 0);
  for (const SelectedResidual& residual : selected) {
    for (int i = 0; i < residual.num_blocks; ++i) {
      const BlockRef& block = residual.blocks[i];
      if (block.kind != BlockRef::Kind::kNode) {
        camera_variable_ |= config.camera_variable;
      } else if (config.variable_nodes[block.node] != 0) {
        touched[block.node] = 1;
      }
    }
  }
  for (int j = 0; j < static_cast<int>(touched.size()); ++j) {
    if (touched[j] != 0) variable_nodes_.push_back(j);
  }
  AddItems(builder, selected);
}

NormalEquations::NormalEquations(const ProblemBuilder& builder,
                                 const std::vector<SelectedResidual>& residuals,
                                 const std::vector<int>& variable_nodes)
    : variable_nodes_(variable_nodes) {
  AddItems(builder, residuals);
}

void NormalEquations::AddItems(const ProblemBuilder& builder,
                               const std::vector<SelectedResidual>& residuals) {
  for (int t = 0; t < builder.num_terms(); ++t) losses_.push_back(MakeLoss(builder.loss(t)));
  std::vector<int> block_of_node(builder.graph().num_nodes(), -1);
  for (int i = 0; i < num_variable_nodes(); ++i) block_of_node[variable_nodes_[i]] = i;
  items_.reserve(residuals.size());
  PointTable points(residuals.size());
  for (const SelectedResidual& residual : residuals) AddItem(residual, block_of_node, &points);
}

void NormalEquations::AddItem(const SelectedResidual& residual,
                              const std::vector<int>& block_of_node,
                              PointTable* points) {
  Item item;
  item.residual = residual;
  item.point = dynamic_cast<const PointCostFunction*>(residual.cost);
  if (Loss(residual.term) == nullptr) item.quadratic = AsNodeQuadratic(residual);
  item.num_residuals = residual.cost->num_residuals();
  max_residuals_ = std::max(max_residuals_, item.num_residuals);
  if (item.point != nullptr) {
    const int found = points->FindOrAdd(items_, residual, *item.point);
    if (found >= 0) {
      Item& shared = items_[found];
      (shared.more < 0 ? shared.more : more_[shared.last_more].next) =
          static_cast<int>(more_.size());
      shared.last_more = static_cast<int>(more_.size());
      more_.push_back({item.point, residual.term, residual.weight, -1});
      return;
    }
  }
  item.first_part = static_cast<int>(parts_.size());
  for (int i = 0; i < residual.num_blocks; ++i) {
    const BlockRef& block = residual.blocks[i];
    Part part;
    part.column = item.width;
    if (block.kind == BlockRef::Kind::kNode) {
      part.block = block_of_node[block.node];
      part.width = part.block >= 0 ? kNodeSize : 0;
      part.affine = item.point == nullptr || !item.point->point().offset(i).isZero(0.0);
    } else {
      part.block = camera_variable_ ? num_variable_nodes() : -1;
      part.offset = block.kind == BlockRef::Kind::kCameraRotation ? 0 : kRotationTangent;
      part.width = camera_variable_ ? kRotationTangent : 0;
    }
    parts_.push_back(part);
    item.width += part.width;
  }
  item.num_parts = residual.num_blocks;
  items_.push_back(item);
  max_blocks_ = std::max(max_blocks_, residual.num_blocks);
  max_linearization_ = std::max(max_linearization_, item.LinearizationSize());
}

std::vector<int> NormalEquations::BlockSizes() const {
  std::vector<int> sizes(variable_nodes_.size(), kNodeSize);
  if (camera_variable_) sizes.push_back(kCameraTangent);
  return sizes;
}

std::vector<BlockPair> NormalEquations::BlockPairs() const {
  std::vector<BlockPair> pairs;
  for (const Item& item : items_) {
    const Part* parts = &parts_[item.first_part];
    for (int a = 0; a < item.num_parts; ++a) {
      for (int b = 0; b < a; ++b) {
        if (parts[a].block < 0 || parts[b].block < 0 || parts[a].block == parts[b].block) continue;
        pairs.push_back({parts[a].block, parts[b].block, parts[a].affine && parts[b].affine});
      }
    }
  }
  return BlockStructure(BlockSizes(), pairs).Pairs();
}

bool NormalEquations::SetStructure(const BlockStructure* structure) {
  structure_ = nullptr;
  entries_.clear();
  for (Item& item : items_) {
    item.first_entry = static_cast<int>(entries_.size());
    const Part* parts = &parts_[item.first_part];
    for (int a = 0; a < item.num_parts; ++a) {
      for (int b = 0; b <= a; ++b) {
        const int row = std::max(parts[a].block, parts[b].block);
        const int column = std::min(parts[a].block, parts[b].block);
        entries_.push_back(column < 0 ? -1 : structure->FindEntry(row, column));
        if (column < 0) continue;
        const int entry = entries_.back();
        const bool affine = parts[a].affine && parts[b].affine;
        if (entry < 0 || (affine && !structure->affine_pair(entry))) return false;
      }
    }
  }
  structure_ = structure;
  return true;
}

void NormalEquations::Plus(const Eigen::VectorXd& delta, DeformationState* state) const {
  for (int i = 0; i < num_variable_nodes(); ++i) {
    Eigen::Map<Eigen::Matrix<double, kNodeSize, 1>>(state->node(variable_nodes_[i])) +=
        delta.segment<kNodeSize>(static_cast<Eigen::Index>(i) * kNodeSize);
  }
  if (!camera_variable_) return;
  const Eigen::Matrix<double, kCameraTangent, 1> step = delta.tail<kCameraTangent>();
  CameraPose& camera = state->camera_from_map;
  const Eigen::Vector4d before = camera.rotation.coeffs();
  ceres::EigenQuaternionManifold().Plus(
      before.data(), step.data(), camera.rotation.coeffs().data());
  camera.translation += step.tail<3>();
}

double NormalEquations::ParameterNorm(const DeformationState& state) const {
  double squared = 0.0;
  for (const int node : variable_nodes_) {
    squared +=
        Eigen::Map<const Eigen::Matrix<double, kNodeSize, 1>>(state.node(node)).squaredNorm();
  }
  if (camera_variable_) {
    squared += 1.0 + state.camera_from_map.translation.squaredNorm();
  }
  return std::sqrt(squared);
}

}  // namespace ceres_ed
