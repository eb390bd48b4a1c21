#include "ceres_ed/solver/normal_equations/normal_equations.h"

#include <ceres_ed/energy/prior_stores.h>

#include <algorithm>
#include <cmath>

#include <ceres/manifold.h>

namespace ceres_ed {
namespace {

constexpr int kRotationTangent = 3;
constexpr int kCameraTangent = 6;

// Returns the quadratic cost of a residual that depends on nodes only, else null.
const QuadraticCost* AsNodeQuadratic(const SelectedResidual& residual) {
  for (int i = 0; i < residual.num_blocks; ++i) {
    if (residual.blocks[i].kind != BlockRef::Kind::kNode) return nullptr;
  }
  return dynamic_cast<const QuadraticCost*>(residual.cost);
}

// Returns whether a residual depends on the affine matrix of its `i`-th block; true if this is not
// known.
bool TouchesAffine(const SelectedResidual& residual, int i) {
  if (residual.store == nullptr || residual.store->form() != ResidualStore::Form::kEdge)
    return true;
  const auto* edges = static_cast<const EdgeStore*>(residual.store);
  return i == 0 && !edges->cost(residual.index).edge().isZero(0.0);
}

}  // namespace

int NormalEquations::Item::LinearizationSize() const {
  return quadratic != nullptr ? quadratic->size() : cost->num_residuals() * (1 + width);
}

void NormalEquations::Clear() {
  variable_nodes_.clear();
  camera_variable_ = false;
  num_dual_points_ = num_dual_ = 0;
  losses_.clear();
  edges_.clear();
  rotations_.clear();
  items_.clear();
  parts_.clear();
  slots_.clear();
  max_residuals_ = max_blocks_ = max_linearization_ = 0;
  structure_ = nullptr;
}

void NormalEquations::Build(const ProblemBuilder& builder,
                            const ProblemConfig& config,
                            DualResiduals dual_residuals) {
  Clear();
  builder.Select(config, &selected_);
  const int num_nodes = builder.graph().num_nodes();
  block_of_node_.assign(num_nodes, -1);
  for (const SelectedResidual& residual : selected_) {
    for (int i = 0; i < residual.num_blocks; ++i) {
      const BlockRef& block = residual.blocks[i];
      if (block.kind != BlockRef::Kind::kNode) {
        camera_variable_ |= config.camera_variable;
      } else if (config.variable_nodes[block.node] != 0) {
        block_of_node_[block.node] = 0;
      }
    }
  }
  for (int j = 0; j < num_nodes; ++j) {
    if (block_of_node_[j] < 0) continue;
    block_of_node_[j] = num_variable_nodes();
    variable_nodes_.push_back(j);
  }
  AddResiduals(builder, selected_);
  // Short lists are needed again in the next frame or round; long ones are a part of the peak.
  constexpr std::size_t kLongList = 100000;
  if (selected_.capacity() > kLongList) std::vector<SelectedResidual>().swap(selected_);
  if (dual_residuals == DualResiduals::kWhereTheyPay) {
    ChooseDualPoints();
    ChooseDualItems();
  }
  AddSlots(builder.graph());
  DealOut(builder.graph());
}

void NormalEquations::Build(const ProblemBuilder& builder,
                            const std::vector<SelectedResidual>& residuals,
                            const std::vector<int>& variable_nodes) {
  Clear();
  variable_nodes_ = variable_nodes;
  block_of_node_.assign(builder.graph().num_nodes(), -1);
  for (int i = 0; i < num_variable_nodes(); ++i) block_of_node_[variable_nodes_[i]] = i;
  AddResiduals(builder, residuals);
  AddSlots(builder.graph());
  DealOut(builder.graph());
}

void NormalEquations::AddResiduals(const ProblemBuilder& builder,
                                   const std::vector<SelectedResidual>& residuals) {
  for (int t = 0; t < builder.num_terms(); ++t) losses_.push_back(MakeLoss(builder.loss(t)));
  points_.Build(builder.graph(), residuals);
  batches_.Build(builder.graph(), residuals);
  for (const SelectedResidual& residual : residuals) {
    const bool has_form = residual.store != nullptr;
    if (has_form && residual.store->form() == ResidualStore::Form::kPoint) continue;
    if (has_form && Loss(residual.term) == nullptr) {
      AddClosedForm(residual);
    } else {
      AddItem(residual, builder.graph());
    }
  }
}

void NormalEquations::AddClosedForm(const SelectedResidual& residual) {
  const int first = residual.blocks[0].node;
  if (residual.store->form() == ResidualStore::Form::kRotation) {
    rotations_.push_back({residual.weight, first, block_of_node_[first], 0});
    return;
  }
  Edge edge;
  edge.cost = &static_cast<const EdgeStore*>(residual.store)->cost(residual.index);
  edge.weight = residual.weight;
  for (int i = 0; i < 2; ++i) {
    edge.nodes[i] = residual.blocks[i].node;
    edge.blocks[i] = block_of_node_[edge.nodes[i]];
  }
  edges_.push_back(edge);
}

void NormalEquations::AddItem(const SelectedResidual& residual, const DeformationGraph& graph) {
  Item item;
  item.residual = residual;
  item.cost = residual.CostFunction(graph);
  if (Loss(residual.term) == nullptr) item.quadratic = AsNodeQuadratic(residual);
  item.first_part = static_cast<int>(parts_.size());
  item.num_parts = residual.num_blocks;
  for (int i = 0; i < residual.num_blocks; ++i) {
    const BlockRef& block = residual.blocks[i];
    Part part;
    part.column = item.width;
    if (block.kind == BlockRef::Kind::kNode) {
      part.block = block_of_node_[block.node];
      part.width = part.block >= 0 ? kNodeSize : 0;
      part.affine = TouchesAffine(residual, i);
    } else {
      part.block = camera_variable_ ? num_variable_nodes() : -1;
      part.offset = block.kind == BlockRef::Kind::kCameraRotation ? 0 : kRotationTangent;
      part.width = camera_variable_ ? kRotationTangent : 0;
    }
    parts_.push_back(part);
    item.width += part.width;
  }
  max_residuals_ = std::max(max_residuals_, item.cost->num_residuals());
  max_blocks_ = std::max(max_blocks_, residual.num_blocks);
  max_linearization_ = std::max(max_linearization_, item.LinearizationSize());
  items_.push_back(std::move(item));
}

std::vector<int> NormalEquations::BlockSizes() const {
  std::vector<int> sizes(variable_nodes_.size(), kNodeSize);
  if (camera_variable_) sizes.push_back(kCameraTangent);
  sizes.insert(sizes.end(), num_dual_, kDualSize);
  return sizes;
}

void NormalEquations::Plus(const Eigen::VectorXd& delta, DeformationState* state) const {
  for (int i = 0; i < num_variable_nodes(); ++i) {
    Eigen::Map<Eigen::Matrix<double, kNodeSize, 1>>(state->node(variable_nodes_[i])) +=
        delta.segment<kNodeSize>(static_cast<Eigen::Index>(i) * kNodeSize);
  }
  if (!camera_variable_) return;
  const Eigen::Matrix<double, kCameraTangent, 1> step =
      delta.segment<kCameraTangent>(static_cast<Eigen::Index>(num_variable_nodes()) * kNodeSize);
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
