// How NormalEquations adds one linearised residual to the blocks that it touches.
#include <ceres_ed/solver/block_products.h>
#include <ceres_ed/solver/normal_equations.h>
#include <ceres_ed/solver/point_linearization.h>

#include <utility>

namespace ceres_ed {
namespace {

constexpr int kCameraTangent = 6;

}  // namespace

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
    if (values == nullptr) continue;
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
    if (values == nullptr) continue;
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

void NormalEquations::AccumulateQuadratic(const Item& item,
                                          const double* linearization,
                                          const BlockRange& range,
                                          double* values,
                                          double* gradient) const {
  using NodeBlock = Eigen::Matrix<double, kNodeSize, kNodeSize>;
  const Eigen::MatrixXd& hessian = item.quadratic->quadratic().hessian;
  const Part* parts = &parts_[item.first_part];
  const int* entry = &entries_[item.first_entry];
  for (int a = 0; a < item.num_parts; ++a) {
    if (parts[a].block >= 0 && range.Has(parts[a].block)) {
      double* g = gradient + structure_->row_offset(parts[a].block);
      for (int i = 0; i < kNodeSize; ++i) g[i] += linearization[a * kNodeSize + i];
    }
    if (values == nullptr) continue;
    for (int b = 0; b <= a; ++b, ++entry) {
      if (*entry < 0) continue;
      const bool a_is_row = parts[a].block >= parts[b].block;
      const int row = a_is_row ? a : b;
      const int column = a_is_row ? b : a;
      if (!range.Has(parts[column].block)) continue;
      Eigen::Map<NodeBlock>(values + structure_->value_offset(*entry)) +=
          item.residual.weight *
          hessian.block<kNodeSize, kNodeSize>(row * kNodeSize, column * kNodeSize);
    }
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
  }
  if (values == nullptr) return;
  if (range.Has(camera)) {
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
  } else if (item.quadratic != nullptr) {
    AccumulateQuadratic(item, linearization, range, values, gradient);
  } else {
    AccumulateGeneral(item, linearization, range, values, gradient);
  }
}

}  // namespace ceres_ed
