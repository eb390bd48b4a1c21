#include "ceres_ed/solver/normal_equations.h"

#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include <ceres/manifold.h>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr int kRotationTangent = 3;
constexpr int kCameraTangent = 6;

using RowMajorMap =
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
using ConstRowMajorMap =
    Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

// out += A^T B for row-major A (K x rows) and B (K x columns); out is column-major with `stride`.
template <int kRows, int kColumns>
void AddProduct(int num_residuals, const double* A, const double* B, int stride, double* out) {
  for (int k = 0; k < num_residuals; ++k) {
    const double* a = A + k * kRows;
    const double* b = B + k * kColumns;
    for (int c = 0; c < kColumns; ++c) {
      double* column = out + c * stride;
      for (int r = 0; r < kRows; ++r) column[r] += a[r] * b[c];
    }
  }
}

void AddProduct(int num_residuals,
                const double* A,
                int rows,
                const double* B,
                int columns,
                int stride,
                double* out) {
  if (rows == kNodeSize && columns == kNodeSize) {
    AddProduct<kNodeSize, kNodeSize>(num_residuals, A, B, stride, out);
  } else if (rows == kRotationTangent && columns == kNodeSize) {
    AddProduct<kRotationTangent, kNodeSize>(num_residuals, A, B, stride, out);
  } else {
    CHECK(rows == kRotationTangent && columns == kRotationTangent);
    AddProduct<kRotationTangent, kRotationTangent>(num_residuals, A, B, stride, out);
  }
}

// Scales residuals and Jacobian so that their plain squares have the gradient, and the Gauss-Newton
// matrix, of the robust cost (Triggs et al. 2000, as in Ceres' corrector). A concave loss keeps its
// first-order part alone: its second-order part would make the matrix indefinite.
class LossCorrection {
 public:
  LossCorrection(double squared_norm, const double rho[3]) : sqrt_rho1_(std::sqrt(rho[1])) {
    residual_scale_ = sqrt_rho1_;
    if (squared_norm == 0.0 || rho[2] <= 0.0) return;
    const double alpha = 1.0 - std::sqrt(1.0 + 2.0 * squared_norm * rho[2] / rho[1]);
    residual_scale_ = sqrt_rho1_ / (1.0 - alpha);
    alpha_per_squared_norm_ = alpha / squared_norm;
  }

  // `residuals` as they came from the cost function; `jacobian` is row-major.
  void CorrectJacobian(const double* residuals, int rows, int columns, double* jacobian) const {
    if (alpha_per_squared_norm_ != 0.0) {
      const Eigen::Map<const Eigen::VectorXd> r(residuals, rows);
      RowMajorMap J(jacobian, rows, columns);
      const Eigen::RowVectorXd r_J = r.transpose() * J;
      J -= alpha_per_squared_norm_ * r * r_J;
    }
    for (int i = 0; i < rows * columns; ++i) jacobian[i] *= sqrt_rho1_;
  }

  void CorrectResiduals(int rows, double* residuals) const {
    for (int i = 0; i < rows; ++i) residuals[i] *= residual_scale_;
  }

 private:
  double sqrt_rho1_;
  double residual_scale_;
  double alpha_per_squared_norm_ = 0.0;
};

}  // namespace

// Buffers of one thread.
class NormalEquations::Scratch {
 public:
  explicit Scratch(const NormalEquations& equations)
      : residuals(equations.max_residuals_),
        jacobian(static_cast<std::size_t>(equations.max_residuals_) * equations.max_width_),
        rotation_jacobian(static_cast<std::size_t>(equations.max_residuals_) * kRotationSize),
        blocks(equations.max_blocks_),
        jacobians(equations.max_blocks_) {}

  std::vector<double> residuals;
  // The parts of an item one after the other, each row-major.
  std::vector<double> jacobian;
  std::vector<double> rotation_jacobian;
  std::vector<const double*> blocks;
  std::vector<double*> jacobians;
};

NormalEquations::NormalEquations(const ProblemBuilder& builder, const ProblemConfig& config) {
  const std::vector<SelectedResidual> selected = builder.Select(config);
  std::vector<int> block_of_node(config.variable_nodes.size(), -1);
  for (const SelectedResidual& residual : selected) {
    for (int i = 0; i < residual.num_blocks; ++i) {
      const BlockRef& block = residual.blocks[i];
      if (block.kind != BlockRef::Kind::kNode) {
        camera_variable_ |= config.camera_variable;
      } else if (config.variable_nodes[block.node] != 0) {
        block_of_node[block.node] = 0;
      }
    }
  }
  for (int j = 0; j < static_cast<int>(block_of_node.size()); ++j) {
    if (block_of_node[j] != 0) continue;
    block_of_node[j] = num_variable_nodes();
    variable_nodes_.push_back(j);
  }
  for (int t = 0; t < builder.num_terms(); ++t) losses_.push_back(MakeLoss(builder.loss(t)));

  items_.reserve(selected.size());
  for (const SelectedResidual& residual : selected) {
    Item item;
    item.residual = residual;
    item.num_residuals = residual.cost->num_residuals();
    item.first_part = static_cast<int>(parts_.size());
    for (int i = 0; i < residual.num_blocks; ++i) {
      const BlockRef& block = residual.blocks[i];
      Part part;
      part.column = item.width;
      if (block.kind == BlockRef::Kind::kNode) {
        part.block = block_of_node[block.node];
        part.width = part.block >= 0 ? kNodeSize : 0;
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
    max_residuals_ = std::max(max_residuals_, item.num_residuals);
    max_width_ = std::max(max_width_, item.width);
    max_blocks_ = std::max(max_blocks_, residual.num_blocks);
  }
}

std::vector<int> NormalEquations::BlockSizes() const {
  std::vector<int> sizes(variable_nodes_.size(), kNodeSize);
  if (camera_variable_) sizes.push_back(kCameraTangent);
  return sizes;
}

std::vector<std::pair<int, int>> NormalEquations::BlockPairs() const {
  std::vector<std::pair<int, int>> pairs;
  for (const Item& item : items_) {
    for (int a = 0; a < item.num_parts; ++a) {
      const int row = parts_[item.first_part + a].block;
      for (int b = 0; b < a; ++b) {
        const int column = parts_[item.first_part + b].block;
        if (row < 0 || column < 0 || row == column) continue;
        pairs.emplace_back(std::max(row, column), std::min(row, column));
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

void NormalEquations::SetStructure(const BlockStructure* structure) {
  structure_ = structure;
  entries_.clear();
  for (Item& item : items_) {
    item.first_entry = static_cast<int>(entries_.size());
    for (int a = 0; a < item.num_parts; ++a) {
      const int row = parts_[item.first_part + a].block;
      for (int b = 0; b <= a; ++b) {
        const int column = parts_[item.first_part + b].block;
        const bool held = row < 0 || column < 0;
        entries_.push_back(
            held ? -1 : structure->FindEntry(std::max(row, column), std::min(row, column)));
        CHECK(held || entries_.back() >= 0) << "block (" << row << ", " << column << ")";
      }
    }
  }
}

bool NormalEquations::EvaluateResidual(const Item& item,
                                       const DeformationState& state,
                                       bool with_jacobian,
                                       Scratch* scratch,
                                       double* cost) const {
  double* jacobian = scratch->jacobian.data();
  const Part* parts = &parts_[item.first_part];
  int rotation_part = -1;
  for (int i = 0; i < item.num_parts; ++i) {
    scratch->blocks[i] = BlockPointer(state, item.residual.blocks[i]);
    double* target = jacobian + item.num_residuals * parts[i].column;
    if (item.residual.blocks[i].kind == BlockRef::Kind::kCameraRotation) {
      rotation_part = i;
      target = scratch->rotation_jacobian.data();
    }
    scratch->jacobians[i] = parts[i].width > 0 ? target : nullptr;
  }
  double* residuals = scratch->residuals.data();
  if (!item.residual.cost->Evaluate(
          scratch->blocks.data(), residuals, with_jacobian ? scratch->jacobians.data() : nullptr)) {
    return false;
  }
  double squared_norm = 0.0;
  for (int r = 0; r < item.num_residuals; ++r) squared_norm += residuals[r] * residuals[r];
  if (!std::isfinite(squared_norm)) return false;
  double rho[3] = {squared_norm, 1.0, 0.0};
  const ceres::LossFunction* loss = losses_[item.residual.term].get();
  if (loss != nullptr) loss->Evaluate(squared_norm, rho);
  for (double& value : rho) value *= item.residual.weight;
  *cost = 0.5 * rho[0];
  if (!with_jacobian) return true;

  if (rotation_part >= 0 && parts[rotation_part].width > 0) {
    double plus_jacobian[kRotationSize * kRotationTangent];
    ceres::EigenQuaternionManifold().PlusJacobian(scratch->blocks[rotation_part], plus_jacobian);
    RowMajorMap(jacobian + item.num_residuals * parts[rotation_part].column,
                item.num_residuals,
                kRotationTangent) =
        ConstRowMajorMap(scratch->rotation_jacobian.data(), item.num_residuals, kRotationSize) *
        ConstRowMajorMap(plus_jacobian, kRotationSize, kRotationTangent);
  }
  const LossCorrection correction(squared_norm, rho);
  for (int i = 0; i < item.num_parts; ++i) {
    correction.CorrectJacobian(residuals,
                               item.num_residuals,
                               parts[i].width,
                               jacobian + item.num_residuals * parts[i].column);
  }
  correction.CorrectResiduals(item.num_residuals, residuals);
  return true;
}

void NormalEquations::Accumulate(const Item& item,
                                 const double* residuals,
                                 const double* jacobian,
                                 int first_block,
                                 int last_block,
                                 double* values,
                                 double* gradient) const {
  const int* entry = &entries_[item.first_entry];
  for (int a = 0; a < item.num_parts; ++a) {
    const Part& part_a = parts_[item.first_part + a];
    const double* J_a = jacobian + item.num_residuals * part_a.column;
    if (part_a.block >= first_block && part_a.block < last_block) {
      double* g = gradient + structure_->row_offset(part_a.block) + part_a.offset;
      for (int k = 0; k < item.num_residuals; ++k) {
        for (int i = 0; i < part_a.width; ++i) g[i] += J_a[k * part_a.width + i] * residuals[k];
      }
    }
    for (int b = 0; b <= a; ++b, ++entry) {
      if (*entry < 0) continue;
      const Part& part_b = parts_[item.first_part + b];
      const double* J_b = jacobian + item.num_residuals * part_b.column;
      const bool a_is_row = std::make_pair(part_a.block, part_a.offset) >=
                            std::make_pair(part_b.block, part_b.offset);
      const Part& row = a_is_row ? part_a : part_b;
      const Part& column = a_is_row ? part_b : part_a;
      if (column.block < first_block || column.block >= last_block) continue;
      const int stride = structure_->size(row.block);
      AddProduct(item.num_residuals,
                 a_is_row ? J_a : J_b,
                 row.width,
                 a_is_row ? J_b : J_a,
                 column.width,
                 stride,
                 values + structure_->value_offset(*entry) + column.offset * stride + row.offset);
    }
  }
}

bool NormalEquations::EvaluateSerial(const DeformationState& state,
                                     double* cost,
                                     std::vector<double>* values,
                                     Eigen::VectorXd* gradient) const {
  Scratch scratch(*this);
  const int num_blocks = structure_->num_blocks();
  for (const Item& item : items_) {
    double item_cost = 0.0;
    if (!EvaluateResidual(item, state, values != nullptr, &scratch, &item_cost)) return false;
    *cost += item_cost;
    if (values == nullptr) continue;
    Accumulate(item,
               scratch.residuals.data(),
               scratch.jacobian.data(),
               0,
               num_blocks,
               values->data(),
               gradient->data());
  }
  return true;
}

// All residuals first, then the sums, each block by one thread in the order of the residuals: the
// same bits as EvaluateSerial at any number of threads.
bool NormalEquations::EvaluateParallel(const DeformationState& state,
                                       int num_threads,
                                       double* cost,
                                       std::vector<double>* values,
                                       Eigen::VectorXd* gradient) const {
  const int num_items = static_cast<int>(items_.size());
  std::vector<std::size_t> residual_offsets(num_items + 1, 0);
  std::vector<std::size_t> jacobian_offsets(num_items + 1, 0);
  for (int i = 0; i < num_items; ++i) {
    const Item& item = items_[i];
    residual_offsets[i + 1] = residual_offsets[i] + item.num_residuals;
    jacobian_offsets[i + 1] =
        jacobian_offsets[i] + (values != nullptr ? item.num_residuals * item.width : 0);
  }
  std::vector<double> residuals(residual_offsets.back());
  std::vector<double> jacobians(jacobian_offsets.back());
  std::vector<double> costs(num_items);
  std::atomic<bool> ok{true};
  ParallelFor(num_threads, num_items, [&](int begin, int end) {
    Scratch scratch(*this);
    for (int i = begin; i < end; ++i) {
      if (!EvaluateResidual(items_[i], state, values != nullptr, &scratch, &costs[i])) {
        ok = false;
        return;
      }
      if (values == nullptr) continue;
      std::copy_n(scratch.residuals.data(),
                  residual_offsets[i + 1] - residual_offsets[i],
                  &residuals[residual_offsets[i]]);
      std::copy_n(scratch.jacobian.data(),
                  jacobian_offsets[i + 1] - jacobian_offsets[i],
                  &jacobians[jacobian_offsets[i]]);
    }
  });
  if (!ok) return false;
  for (const double item_cost : costs) *cost += item_cost;
  if (values == nullptr) return true;
  ParallelFor(num_threads, structure_->num_blocks(), [&](int begin, int end) {
    for (int i = 0; i < num_items; ++i) {
      Accumulate(items_[i],
                 &residuals[residual_offsets[i]],
                 jacobians.data() + jacobian_offsets[i],
                 begin,
                 end,
                 values->data(),
                 gradient->data());
    }
  });
  return true;
}

bool NormalEquations::Evaluate(const DeformationState& state,
                               int num_threads,
                               double* cost,
                               std::vector<double>* values,
                               Eigen::VectorXd* gradient) const {
  CHECK(structure_ != nullptr) << "SetStructure comes first";
  *cost = 0.0;
  values->assign(structure_->num_values(), 0.0);
  gradient->setZero(structure_->num_rows());
  return num_threads > 1 ? EvaluateParallel(state, num_threads, cost, values, gradient)
                         : EvaluateSerial(state, cost, values, gradient);
}

bool NormalEquations::EvaluateCost(const DeformationState& state,
                                   int num_threads,
                                   double* cost) const {
  CHECK(structure_ != nullptr) << "SetStructure comes first";
  *cost = 0.0;
  return num_threads > 1 ? EvaluateParallel(state, num_threads, cost, nullptr, nullptr)
                         : EvaluateSerial(state, cost, nullptr, nullptr);
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
