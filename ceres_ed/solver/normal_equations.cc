#include "ceres_ed/solver/normal_equations.h"

#include <ceres_ed/solver/block_products.h>
#include <ceres_ed/solver/loss_correction.h>
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

}  // namespace

// The warped point's derivative D is all that the blocks of its nodes have in common.
struct NormalEquations::PointLinearization {
  // R_c^T D^T D R_c, and D^T r in the map frame.
  Eigen::Matrix3d M;
  Eigen::Vector3d v;
  // With a variable camera: the Jacobian by its tangent is D C with C = [-2 [R_c p]_x, I].
  // D^T D and D^T r in the camera frame, and R_c p.
  Eigen::Matrix3d M_camera;
  Eigen::Vector3d v_camera;
  Eigen::Matrix3d rotation;
  Eigen::Vector3d rotated;
};

int NormalEquations::Item::LinearizationSize() const {
  static_assert(sizeof(PointLinearization) % sizeof(double) == 0);
  return point != nullptr ? static_cast<int>(sizeof(PointLinearization) / sizeof(double))
                          : num_residuals * (1 + width);
}

// Buffers of one thread.
class NormalEquations::Scratch {
 public:
  explicit Scratch(const NormalEquations& equations)
      : linearization(equations.max_linearization_),
        residuals(equations.max_residuals_),
        derivative(static_cast<std::size_t>(equations.max_residuals_) * kRotationSize),
        blocks(equations.max_blocks_),
        jacobians(equations.max_blocks_) {}

  std::vector<double> linearization;
  std::vector<double> residuals;
  // By a quaternion, or by a point.
  std::vector<double> derivative;
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
  for (const SelectedResidual& residual : selected) AddItem(residual, block_of_node);
}

void NormalEquations::AddItem(const SelectedResidual& residual,
                              const std::vector<int>& block_of_node) {
  Item item;
  item.residual = residual;
  item.point = dynamic_cast<const PointCostFunction*>(residual.cost);
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
  max_blocks_ = std::max(max_blocks_, residual.num_blocks);
  max_linearization_ = std::max(max_linearization_, item.LinearizationSize());
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

// The robust, weighted cost of an item; false when its residuals aren't finite.
bool NormalEquations::ApplyLoss(const Item& item,
                                const double* residuals,
                                double rho[3],
                                double* cost) const {
  double squared_norm = 0.0;
  for (int r = 0; r < item.num_residuals; ++r) squared_norm += residuals[r] * residuals[r];
  if (!std::isfinite(squared_norm)) return false;
  rho[0] = squared_norm;
  rho[1] = 1.0;
  rho[2] = 0.0;
  const ceres::LossFunction* loss = losses_[item.residual.term].get();
  if (loss != nullptr) loss->Evaluate(squared_norm, rho);
  for (int i = 0; i < 3; ++i) rho[i] *= item.residual.weight;
  *cost = 0.5 * rho[0];
  return true;
}

bool NormalEquations::EvaluateGeneral(const Item& item,
                                      const DeformationState& state,
                                      double* linearization,
                                      Scratch* scratch,
                                      double* cost) const {
  const bool with_jacobian = linearization != nullptr;
  double* residuals = with_jacobian ? linearization : scratch->residuals.data();
  double* jacobian = with_jacobian ? linearization + item.num_residuals : nullptr;
  const Part* parts = &parts_[item.first_part];
  int rotation_part = -1;
  for (int i = 0; i < item.num_parts; ++i) {
    scratch->blocks[i] = BlockPointer(state, item.residual.blocks[i]);
    scratch->jacobians[i] = nullptr;
    if (!with_jacobian || parts[i].width == 0) continue;
    if (item.residual.blocks[i].kind == BlockRef::Kind::kCameraRotation) {
      rotation_part = i;
      scratch->jacobians[i] = scratch->derivative.data();
    } else {
      scratch->jacobians[i] = jacobian + item.num_residuals * parts[i].column;
    }
  }
  if (!item.residual.cost->Evaluate(
          scratch->blocks.data(), residuals, with_jacobian ? scratch->jacobians.data() : nullptr)) {
    return false;
  }
  double rho[3];
  if (!ApplyLoss(item, residuals, rho, cost)) return false;
  if (!with_jacobian) return true;
  if (rotation_part >= 0) {
    double plus_jacobian[kRotationSize * kRotationTangent];
    ceres::EigenQuaternionManifold().PlusJacobian(scratch->blocks[rotation_part], plus_jacobian);
    RowMajorMap(jacobian + item.num_residuals * parts[rotation_part].column,
                item.num_residuals,
                kRotationTangent) =
        ConstRowMajorMap(scratch->derivative.data(), item.num_residuals, kRotationSize) *
        ConstRowMajorMap(plus_jacobian, kRotationSize, kRotationTangent);
  }
  const double squared_norm =
      Eigen::Map<const Eigen::VectorXd>(residuals, item.num_residuals).squaredNorm();
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

bool NormalEquations::EvaluatePoint(const Item& item,
                                    const DeformationState& state,
                                    double* linearization,
                                    Scratch* scratch,
                                    double* cost) const {
  const BoundPoint& point = item.point->point();
  for (int i = 0; i < point.num_nodes(); ++i) {
    scratch->blocks[i] = BlockPointer(state, item.residual.blocks[i]);
  }
  Eigen::Vector3d warped = WarpToMap(point, scratch->blocks.data());
  const CameraPose& camera = state.camera_from_map;
  Eigen::Vector3d rotated = warped;
  if (item.point->has_camera()) {
    rotated = camera.rotation * warped;
    warped = rotated + camera.translation;
  }
  double* residuals = scratch->residuals.data();
  double* derivative = linearization != nullptr ? scratch->derivative.data() : nullptr;
  if (!item.point->EvaluateAtPoint(warped.data(), residuals, derivative)) return false;
  double rho[3];
  if (!ApplyLoss(item, residuals, rho, cost)) return false;
  if (linearization == nullptr) return true;
  const Eigen::Map<const Eigen::VectorXd> r(residuals, item.num_residuals);
  const LossCorrection correction(r.squaredNorm(), rho);
  correction.CorrectJacobian(residuals, item.num_residuals, 3, derivative);
  correction.CorrectResiduals(item.num_residuals, residuals);
  PointLinearization& linear = *reinterpret_cast<PointLinearization*>(linearization);
  linear.M_camera.setZero();
  linear.v_camera.setZero();
  for (int k = 0; k < item.num_residuals; ++k) {
    const Eigen::Map<const Eigen::Vector3d> d(derivative + 3 * k);
    linear.M_camera += d * d.transpose();
    linear.v_camera += residuals[k] * d;
  }
  linear.M = linear.M_camera;
  linear.v = linear.v_camera;
  if (item.point->has_camera()) {
    linear.rotation = camera.rotation.toRotationMatrix();
    linear.rotated = rotated;
    linear.M = linear.rotation.transpose() * linear.M_camera * linear.rotation;
    linear.v = linear.rotation.transpose() * linear.v_camera;
  }
  return true;
}

bool NormalEquations::EvaluateItem(const Item& item,
                                   const DeformationState& state,
                                   double* linearization,
                                   Scratch* scratch,
                                   double* cost) const {
  return item.point != nullptr ? EvaluatePoint(item, state, linearization, scratch, cost)
                               : EvaluateGeneral(item, state, linearization, scratch, cost);
}

void NormalEquations::AccumulateGeneral(const Item& item,
                                        const double* linearization,
                                        const BlockRange& range,
                                        double* values,
                                        double* gradient) const {
  const double* residuals = linearization;
  const double* jacobian = linearization + item.num_residuals;
  const int* entry = &entries_[item.first_entry];
  for (int a = 0; a < item.num_parts; ++a) {
    const Part& part_a = parts_[item.first_part + a];
    const double* J_a = jacobian + item.num_residuals * part_a.column;
    if (part_a.block >= 0 && range.Has(part_a.block)) {
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
      if (!range.Has(column.block)) continue;
      const int stride = structure_->size(row.block);
      AddJacobianProduct(
          item.num_residuals,
          a_is_row ? J_a : J_b,
          row.width,
          a_is_row ? J_b : J_a,
          column.width,
          stride,
          values + structure_->value_offset(*entry) + column.offset * stride + row.offset);
    }
  }
}

void NormalEquations::AccumulatePoint(const Item& item,
                                      const double* linearization,
                                      const BlockRange& range,
                                      double* values,
                                      double* gradient) const {
  const auto& linear = *reinterpret_cast<const PointLinearization*>(linearization);
  const BoundPoint& point = item.point->point();
  const Part* parts = &parts_[item.first_part];
  const int* entry = &entries_[item.first_entry];
  // [offset; 1] of each node: its Jacobian is weight * [offset; 1]^T (x) D.
  double lever[kMaxBoundNodes][4];
  for (int a = 0; a < point.num_nodes(); ++a) {
    Eigen::Map<Eigen::Vector4d>(lever[a]) << point.offset(a), 1.0;
    if (parts[a].block >= 0 && range.Has(parts[a].block)) {
      double* g = gradient + structure_->row_offset(parts[a].block);
      for (int i = 0; i < 4; ++i) {
        const double factor = point.weight(a) * lever[a][i];
        for (int r = 0; r < 3; ++r) g[3 * i + r] += factor * linear.v[r];
      }
    }
    for (int b = 0; b <= a; ++b, ++entry) {
      if (*entry < 0) continue;
      const bool a_is_row = parts[a].block >= parts[b].block;
      const int row = a_is_row ? a : b;
      const int column = a_is_row ? b : a;
      if (!range.Has(parts[column].block)) continue;
      AddPointProduct(point.weight(a) * point.weight(b),
                      lever[row],
                      lever[column],
                      linear.M,
                      values + structure_->value_offset(*entry));
    }
  }
  if (item.point->has_camera() && camera_variable_) {
    AccumulateCamera(item, linearization, range, values, gradient);
  }
}

// The camera's rows: its block is the last one, so it is never a column to a node's row.
void NormalEquations::AccumulateCamera(const Item& item,
                                       const double* linearization,
                                       const BlockRange& range,
                                       double* values,
                                       double* gradient) const {
  const auto& linear = *reinterpret_cast<const PointLinearization*>(linearization);
  const BoundPoint& point = item.point->point();
  const int camera = num_variable_nodes();
  // d(R_c p) = -2 [R_c p]_x delta: the manifold's tangent is half the rotation vector.
  Eigen::Matrix3d minus_two_cross;
  const Eigen::Vector3d& q = linear.rotated;
  minus_two_cross << 0.0, 2.0 * q.z(), -2.0 * q.y(), -2.0 * q.z(), 0.0, 2.0 * q.x(), 2.0 * q.y(),
      -2.0 * q.x(), 0.0;
  Eigen::Matrix<double, 3, kCameraTangent> C;
  C << minus_two_cross, Eigen::Matrix3d::Identity();
  const Eigen::Matrix<double, kCameraTangent, 3> C_M = C.transpose() * linear.M_camera;
  if (range.Has(camera)) {
    Eigen::Map<Eigen::Matrix<double, kCameraTangent, 1>>(
        gradient + structure_->row_offset(camera)) += C.transpose() * linear.v_camera;
    const int diagonal = structure_->column_begin(camera);
    Eigen::Map<Eigen::Matrix<double, kCameraTangent, kCameraTangent>>(
        values + structure_->value_offset(diagonal)) += C_M * C;
  }
  const Eigen::Matrix<double, kCameraTangent, 3> C_D = C_M * linear.rotation;
  // Entries of part (rotation, node) stand in the row after those of the nodes.
  const int first = item.first_entry + point.num_nodes() * (point.num_nodes() + 1) / 2;
  const Part* parts = &parts_[item.first_part];
  for (int a = 0; a < point.num_nodes(); ++a) {
    if (parts[a].block < 0 || !range.Has(parts[a].block)) continue;
    Eigen::Map<Eigen::Matrix<double, kCameraTangent, kNodeSize>> out(
        values + structure_->value_offset(entries_[first + a]));
    for (int i = 0; i < 3; ++i) {
      out.middleCols<3>(3 * i) += (point.weight(a) * point.offset(a)[i]) * C_D;
    }
    out.middleCols<3>(kNodeTranslationOffset) += point.weight(a) * C_D;
  }
}

void NormalEquations::Accumulate(const Item& item,
                                 const double* linearization,
                                 const BlockRange& range,
                                 double* values,
                                 double* gradient) const {
  if (item.point != nullptr) {
    AccumulatePoint(item, linearization, range, values, gradient);
  } else {
    AccumulateGeneral(item, linearization, range, values, gradient);
  }
}

bool NormalEquations::EvaluateSerial(const DeformationState& state,
                                     double* cost,
                                     std::vector<double>* values,
                                     Eigen::VectorXd* gradient) const {
  Scratch scratch(*this);
  double* linearization = values != nullptr ? scratch.linearization.data() : nullptr;
  const BlockRange all{0, structure_->num_blocks()};
  for (const Item& item : items_) {
    double item_cost = 0.0;
    if (!EvaluateItem(item, state, linearization, &scratch, &item_cost)) return false;
    *cost += item_cost;
    if (values == nullptr) continue;
    Accumulate(item, linearization, all, values->data(), gradient->data());
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
  std::vector<std::size_t> offsets(num_items + 1, 0);
  for (int i = 0; i < num_items && values != nullptr; ++i) {
    offsets[i + 1] = offsets[i] + items_[i].LinearizationSize();
  }
  std::vector<double> linearizations(offsets.back());
  std::vector<double> costs(num_items);
  std::atomic<bool> ok{true};
  ParallelFor(num_threads, num_items, [&](int begin, int end) {
    Scratch scratch(*this);
    for (int i = begin; i < end; ++i) {
      double* linearization = values != nullptr ? &linearizations[offsets[i]] : nullptr;
      if (!EvaluateItem(items_[i], state, linearization, &scratch, &costs[i])) {
        ok = false;
        return;
      }
    }
  });
  if (!ok) return false;
  for (const double item_cost : costs) *cost += item_cost;
  if (values == nullptr) return true;
  ParallelFor(num_threads, structure_->num_blocks(), [&](int begin, int end) {
    for (int i = 0; i < num_items; ++i) {
      Accumulate(
          items_[i], &linearizations[offsets[i]], {begin, end}, values->data(), gradient->data());
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
