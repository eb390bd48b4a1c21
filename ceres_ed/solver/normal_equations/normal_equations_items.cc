// The part of NormalEquations that treats residuals without a closed form.
#include <ceres_ed/solver/normal_equations/block_products.h>
#include <ceres_ed/solver/normal_equations/loss_correction.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>

#include <cmath>
#include <cstddef>
#include <utility>

#include <ceres/manifold.h>

namespace ceres_ed {
namespace {

constexpr int kRotationTangent = 3;

using RowMajorMap =
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
using ConstRowMajorMap =
    Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

}  // namespace

// The buffers of one task. A linearisation is corrected for the loss. It consists of the residuals
// and then the parts of the Jacobian one after the other, each row-major; for a quadratic cost it
// is the gradient.
struct NormalEquations::ItemScratch {
  explicit ItemScratch(const NormalEquations& equations)
      : linearization(equations.max_linearization_),
        residuals(equations.max_residuals_),
        by_quaternion(static_cast<std::size_t>(equations.max_residuals_) * kRotationSize),
        blocks(equations.max_blocks_),
        jacobians(equations.max_blocks_) {}

  std::vector<double> linearization;
  std::vector<double> residuals;
  std::vector<double> by_quaternion;
  std::vector<const double*> blocks;
  std::vector<double*> jacobians;
};

// Adds the robust, weighted cost of a residual. Returns false if it is not finite.
bool NormalEquations::ApplyLoss(int term,
                                double weight,
                                int num_residuals,
                                const double* residuals,
                                double rho[3],
                                double* cost) const {
  double squared_norm = 0.0;
  for (int r = 0; r < num_residuals; ++r) squared_norm += residuals[r] * residuals[r];
  if (!std::isfinite(squared_norm)) return false;
  rho[0] = squared_norm;
  rho[1] = 1.0;
  rho[2] = 0.0;
  const ceres::LossFunction* loss = Loss(term);
  if (loss != nullptr) loss->Evaluate(squared_norm, rho);
  for (int i = 0; i < 3; ++i) rho[i] *= weight;
  *cost += 0.5 * rho[0];
  return true;
}

bool NormalEquations::LinearizeItem(const Item& item,
                                    const DeformationState& state,
                                    double* linearization,
                                    ItemScratch* scratch,
                                    double* cost) const {
  const int num_residuals = item.cost->num_residuals();
  const bool with_jacobian = linearization != nullptr;
  double* residuals = with_jacobian ? linearization : scratch->residuals.data();
  double* jacobian = with_jacobian ? linearization + num_residuals : nullptr;
  const Part* parts = &parts_[item.first_part];
  int rotation_part = -1;
  for (int i = 0; i < item.num_parts; ++i) {
    scratch->blocks[i] = BlockPointer(state, item.residual.blocks[i]);
    scratch->jacobians[i] = nullptr;
    if (!with_jacobian || parts[i].width == 0) continue;
    if (item.residual.blocks[i].kind == BlockRef::Kind::kCameraRotation) {
      rotation_part = i;
      scratch->jacobians[i] = scratch->by_quaternion.data();
    } else {
      scratch->jacobians[i] = jacobian + num_residuals * parts[i].column;
    }
  }
  if (!item.cost->Evaluate(
          scratch->blocks.data(), residuals, with_jacobian ? scratch->jacobians.data() : nullptr)) {
    return false;
  }
  double rho[3];
  if (!ApplyLoss(item.residual.term, item.residual.weight, num_residuals, residuals, rho, cost)) {
    return false;
  }
  if (!with_jacobian) return true;
  if (rotation_part >= 0) {
    double plus_jacobian[kRotationSize * kRotationTangent];
    ceres::EigenQuaternionManifold().PlusJacobian(scratch->blocks[rotation_part], plus_jacobian);
    RowMajorMap(
        jacobian + num_residuals * parts[rotation_part].column, num_residuals, kRotationTangent) =
        ConstRowMajorMap(scratch->by_quaternion.data(), num_residuals, kRotationSize) *
        ConstRowMajorMap(plus_jacobian, kRotationSize, kRotationTangent);
  }
  const double squared_norm =
      Eigen::Map<const Eigen::VectorXd>(residuals, num_residuals).squaredNorm();
  const LossCorrection correction(squared_norm, rho);
  for (int i = 0; i < item.num_parts; ++i) {
    correction.CorrectJacobian(
        residuals, num_residuals, parts[i].width, jacobian + num_residuals * parts[i].column);
  }
  correction.CorrectResiduals(num_residuals, residuals);
  return true;
}

// Adds J_a^T r of one part to the gradient; `slot` is the slot of its diagonal block.
void NormalEquations::AccumulateGradient(
    const Item& item, int part, int slot, const double* linearization, const Sums& sums) const {
  const Part& part_a = parts_[item.first_part + part];
  if (part_a.block < 0) return;
  const int num_residuals = item.cost->num_residuals();
  const double* residuals = linearization;
  const double* J_a = linearization + num_residuals * (1 + part_a.column);
  double* g = Gradient(slot, sums) + part_a.offset;
  for (int k = 0; k < num_residuals; ++k) {
    for (int i = 0; i < part_a.width; ++i) g[i] += J_a[k * part_a.width + i] * residuals[k];
  }
}

void NormalEquations::AccumulateItem(const Item& item,
                                     const double* linearization,
                                     const Sums& sums) const {
  if (item.num_dual > 0) {
    SpreadDualItem(item, linearization, sums);
    return;
  }
  const int num_residuals = item.cost->num_residuals();
  const double* jacobian = linearization + num_residuals;
  int slot = item.first_slot;
  for (int a = 0; a < item.num_parts; ++a) {
    const Part& part_a = parts_[item.first_part + a];
    const double* J_a = jacobian + num_residuals * part_a.column;
    AccumulateGradient(item, a, slot + a, linearization, sums);
    if (sums.values == nullptr) {
      slot += a + 1;
      continue;
    }
    for (int b = 0; b <= a; ++b, ++slot) {
      if (slots_[slot].row < 0) continue;
      const Part& part_b = parts_[item.first_part + b];
      const double* J_b = jacobian + num_residuals * part_b.column;
      const bool a_is_row = std::make_pair(part_a.block, part_a.offset) >=
                            std::make_pair(part_b.block, part_b.offset);
      const Part& row = a_is_row ? part_a : part_b;
      const Part& column = a_is_row ? part_b : part_a;
      const int stride = structure_->size(row.block);
      AddJacobianProduct(num_residuals,
                         a_is_row ? J_a : J_b,
                         row.width,
                         a_is_row ? J_b : J_a,
                         column.width,
                         stride,
                         Values(slot, sums) + column.offset * stride + row.offset);
    }
  }
}

bool NormalEquations::LinearizeQuadratic(const Item& item,
                                         const DeformationState& state,
                                         double* gradient,
                                         ItemScratch* scratch,
                                         double* cost) const {
  for (int i = 0; i < item.num_parts; ++i) {
    scratch->blocks[i] = BlockPointer(state, item.residual.blocks[i]);
  }
  const Quadratic& quadratic = item.quadratic->quadratic();
  const double weight = item.residual.weight;
  const Eigen::VectorXd d = item.quadratic->Difference(scratch->blocks.data());
  const Eigen::VectorXd curved = quadratic.hessian * d;
  const double value =
      weight * (quadratic.constant + quadratic.gradient.dot(d) + 0.5 * d.dot(curved));
  if (gradient != nullptr) {
    Eigen::Map<Eigen::VectorXd>(gradient, d.size()) = weight * (quadratic.gradient + curved);
  }
  *cost += value;
  return std::isfinite(value);
}

void NormalEquations::AccumulateQuadratic(const Item& item,
                                          const double* gradient,
                                          const Sums& sums) const {
  using NodeBlock = Eigen::Matrix<double, kNodeSize, kNodeSize>;
  const Eigen::MatrixXd& hessian = item.quadratic->quadratic().hessian;
  const Part* parts = &parts_[item.first_part];
  int slot = item.first_slot;
  for (int a = 0; a < item.num_parts; ++a) {
    if (parts[a].block >= 0) {
      double* g = Gradient(slot + a, sums);
      for (int i = 0; i < kNodeSize; ++i) g[i] += gradient[a * kNodeSize + i];
    }
    if (sums.values == nullptr) {
      slot += a + 1;
      continue;
    }
    for (int b = 0; b <= a; ++b, ++slot) {
      if (slots_[slot].row < 0) continue;
      const bool a_is_row = parts[a].block >= parts[b].block;
      const int row = a_is_row ? a : b;
      const int column = a_is_row ? b : a;
      Eigen::Map<NodeBlock>(Values(slot, sums)) +=
          item.residual.weight *
          hessian.block<kNodeSize, kNodeSize>(row * kNodeSize, column * kNodeSize);
    }
  }
}

bool NormalEquations::AddItems(const Task& task,
                               const DeformationState& state,
                               const Sums& sums,
                               double* cost) const {
  if (task.items.empty()) return true;
  ItemScratch scratch(*this);
  double* linearization = sums.gradient != nullptr ? scratch.linearization.data() : nullptr;
  for (const int i : task.items) {
    const Item& item = items_[i];
    if (item.quadratic != nullptr) {
      if (!LinearizeQuadratic(item, state, linearization, &scratch, cost)) return false;
      if (linearization != nullptr) AccumulateQuadratic(item, linearization, sums);
    } else {
      if (!LinearizeItem(item, state, linearization, &scratch, cost)) return false;
      if (linearization != nullptr) AccumulateItem(item, linearization, sums);
    }
  }
  return true;
}

}  // namespace ceres_ed
