// The part of NormalEquations that treats points and wide residuals with dual unknowns.
#include <ceres_ed/solver/normal_equations/normal_equations.h>

#include <algorithm>
#include <cmath>

namespace ceres_ed {
namespace {

constexpr int kAffineSize = kNodeTranslationOffset;
// Dual unknowns are used for points if there are fewer of them than this share of the affine
// parameters that they keep separate.
constexpr double kFewDuals = 0.7;
// A residual is wide if it depends on at least so many nodes and camera parts, and if its own rows
// are fewer than this share of theirs.
constexpr int kWideParts = 24;
constexpr double kFewRows = 0.25;
// The rounding error of the moments.
constexpr double kRankTolerance = 1e-15;

// Returns Q with Q^T Q = M; if the rank is lower, the last rows are zero. The factorisation is
// pivoted: each row starts from the largest remaining entry of the diagonal. `moments` is the lower
// triangle of M row by row.
Eigen::Matrix3d SquareRoot(const double* moments) {
  Eigen::Matrix3d M;
  M << moments[0], moments[1], moments[3], moments[1], moments[2], moments[4], moments[3],
      moments[4], moments[5];
  const double smallest = kRankTolerance * M.trace();
  Eigen::Matrix3d Q = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) {
    int pivot = 0;
    const double largest = M.diagonal().maxCoeff(&pivot);
    if (!(largest > smallest)) break;
    Q.row(k) = M.row(pivot) / std::sqrt(largest);
    M -= Q.row(k).transpose() * Q.row(k);
  }
  return Q;
}

}  // namespace

void NormalEquations::ChooseDualPoints() {
  if (camera_variable_) return;
  std::vector<char> coupled(num_variable_nodes(), 0);
  int num_points = 0;
  for (const PointGroup& group : points_.groups()) {
    num_points += group.num_points;
    for (int a = 0; a < group.num_nodes; ++a) {
      const int block = block_of_node_[points_.nodes(group)[a]];
      if (block >= 0) coupled[block] = 1;
    }
  }
  const auto num_coupled = std::count(coupled.begin(), coupled.end(), 1);
  if (kDualSize * num_points < kFewDuals * kAffineSize * num_coupled) {
    num_dual_points_ = num_dual_ = num_points;
  }
}

void NormalEquations::ChooseDualItems() {
  for (Item& item : items_) {
    if (item.quadratic != nullptr) continue;
    const Part* parts = &parts_[item.first_part];
    const auto num_varying = std::count_if(
        parts, parts + item.num_parts, [](const Part& part) { return part.block >= 0; });
    const int num_dual = (item.cost->num_residuals() + kDualSize - 1) / kDualSize;
    if (num_varying < kWideParts || kDualSize * num_dual > kFewRows * kNodeSize * num_varying) {
      continue;
    }
    item.first_dual = num_dual_;
    item.num_dual = num_dual;
    num_dual_ += num_dual;
  }
}

void NormalEquations::AddDualItemSlots(const Item& item) {
  const Part* parts = &parts_[item.first_part];
  for (int a = 0; a < item.num_parts; ++a) AddSlot(parts[a].block, parts[a].block, true);
  for (int d = 0; d < item.num_dual; ++d) {
    for (int a = 0; a < item.num_parts; ++a) {
      AddSlot(DualBlock(item.first_dual + d), parts[a].block, true);
    }
  }
}

// The dual rows are those of the Jacobian; the last dual block may be filled up with rows of zeros.
void NormalEquations::SpreadDualItem(const Item& item,
                                     const double* linearization,
                                     const Sums& sums) const {
  const int num_residuals = item.cost->num_residuals();
  const double* jacobian = linearization + num_residuals;
  const Part* parts = &parts_[item.first_part];
  for (int a = 0; a < item.num_parts; ++a) {
    AccumulateGradient(item, a, item.first_slot + a, linearization, sums);
  }
  if (sums.values == nullptr) return;
  int slot = item.first_slot + item.num_parts;
  for (int d = 0; d < item.num_dual; ++d) {
    for (int a = 0; a < item.num_parts; ++a, ++slot) {
      const Part& part = parts[a];
      if (part.block < 0) continue;
      double* values = Values(slot, sums) + part.offset * kDualSize;
      const int first = d * kDualSize;
      const int rows = std::min(kDualSize, num_residuals - first);
      for (int r = 0; r < rows; ++r) {
        const double* row = jacobian + num_residuals * part.column + (first + r) * part.width;
        for (int i = 0; i < part.width; ++i) values[i * kDualSize + r] += row[i];
      }
    }
  }
}

// Adds the slots of each point with its nodes; they follow the slots of the nodes themselves.
void NormalEquations::AddDualSlots(const PointGroup& group) {
  const int* blocks = &group_blocks_[group.first_node];
  for (int p = 0; p < group.num_points; ++p) {
    const int dual = DualBlock(group.first_point + p);
    for (int a = 0; a < group.num_nodes; ++a) AddSlot(dual, blocks[a], true);
  }
}

int NormalEquations::DiagonalSlot(int group, int node) const {
  return group_slots_[group] + (num_dual_points_ > 0 ? node : node * (node + 1) / 2 + node);
}

// The dual rows are w_a [v - g_a; 1]^T (x) Q.
void NormalEquations::SpreadDuals(int index, const double* moments, const Sums& sums) const {
  const PointGroup& group = points_.groups()[index];
  const Eigen::Vector3d* positions = &group_positions_[group.first_node];
  const int* blocks = &group_blocks_[group.first_node];
  int slot = group_slots_[index] + group.num_nodes;
  for (int p = 0; p < group.num_points; ++p) {
    const Eigen::Matrix3d Q = SquareRoot(moments + 6 * p);
    const Eigen::Map<const Eigen::Vector3d> lever(points_.levers(group) + 3 * p);
    const double* weights = points_.weights(group) + p * group.num_nodes;
    for (int a = 0; a < group.num_nodes; ++a, ++slot) {
      if (blocks[a] < 0) continue;
      Eigen::Map<Eigen::Matrix<double, kDualSize, kNodeSize>> J(Values(slot, sums));
      const Eigen::Vector3d offset = lever + positions[0] - positions[a];
      for (int i = 0; i < 3; ++i) J.middleCols<3>(3 * i) = weights[a] * offset[i] * Q;
      J.middleCols<3>(kNodeTranslationOffset) = weights[a] * Q;
    }
  }
}

void NormalEquations::SetDualDiagonals(double* values) const {
  for (int k = 0; k < num_dual_; ++k) {
    const int block = structure_->num_blocks() - num_dual_ + k;
    double* diagonal = values + structure_->value_offset(structure_->column_begin(block));
    for (int i = 0; i < kDualSize; ++i) diagonal[i * kDualSize + i] = -1.0;
  }
}

}  // namespace ceres_ed
