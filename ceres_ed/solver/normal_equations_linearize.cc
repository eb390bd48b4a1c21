// How NormalEquations evaluates one residual.
#include <ceres_ed/solver/loss_correction.h>
#include <ceres_ed/solver/normal_equations.h>
#include <ceres_ed/solver/point_linearization.h>

#include <cmath>
#include <cstddef>

#include <ceres/manifold.h>

namespace ceres_ed {
namespace {

constexpr int kRotationTangent = 3;

using RowMajorMap =
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
using ConstRowMajorMap =
    Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

}  // namespace

NormalEquations::Scratch::Scratch(const NormalEquations& equations)
    : linearization(equations.max_linearization_),
      residuals(equations.max_residuals_),
      derivative(static_cast<std::size_t>(equations.max_residuals_) * kRotationSize),
      blocks(equations.max_blocks_),
      jacobians(equations.max_blocks_) {}

// Adds the robust, weighted cost of a residual; false when it isn't finite.
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
  if (!ApplyLoss(
          item.residual.term, item.residual.weight, item.num_residuals, residuals, rho, cost)) {
    return false;
  }
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

bool NormalEquations::AddPointResidual(const PointResidual& residual,
                                       const Eigen::Vector3d& warped,
                                       PointLinearization* linear,
                                       Scratch* scratch,
                                       double* cost) const {
  const int num_residuals = residual.cost->num_residuals();
  double* residuals = scratch->residuals.data();
  double* derivative = linear != nullptr ? scratch->derivative.data() : nullptr;
  if (!residual.cost->EvaluateAtPoint(warped.data(), residuals, derivative)) return false;
  double rho[3];
  if (!ApplyLoss(residual.term, residual.weight, num_residuals, residuals, rho, cost)) return false;
  if (linear == nullptr) return true;
  const Eigen::Map<const Eigen::VectorXd> r(residuals, num_residuals);
  const LossCorrection correction(r.squaredNorm(), rho);
  correction.CorrectJacobian(residuals, num_residuals, 3, derivative);
  correction.CorrectResiduals(num_residuals, residuals);
  for (int k = 0; k < num_residuals; ++k) {
    const Eigen::Map<const Eigen::Vector3d> d(derivative + 3 * k);
    linear->M_camera += d * d.transpose();
    linear->v_camera += residuals[k] * d;
  }
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
  auto* linear = reinterpret_cast<PointLinearization*>(linearization);
  if (linear != nullptr) {
    linear->M_camera.setZero();
    linear->v_camera.setZero();
  }
  const PointResidual first{item.point, item.residual.term, item.residual.weight, item.more};
  for (const PointResidual* residual = &first;;) {
    if (!AddPointResidual(*residual, warped, linear, scratch, cost)) return false;
    if (residual->next < 0) break;
    residual = &more_[residual->next];
  }
  if (linear == nullptr) return true;
  linear->M = linear->M_camera;
  linear->v = linear->v_camera;
  if (item.point->has_camera()) {
    linear->rotation = camera.rotation.toRotationMatrix();
    linear->rotated = rotated;
    linear->M = linear->rotation.transpose() * linear->M_camera * linear->rotation;
    linear->v = linear->rotation.transpose() * linear->v_camera;
  }
  return true;
}

bool NormalEquations::EvaluateQuadratic(const Item& item,
                                        const DeformationState& state,
                                        double* linearization,
                                        Scratch* scratch,
                                        double* cost) const {
  for (int i = 0; i < item.num_parts; ++i) {
    scratch->blocks[i] = BlockPointer(state, item.residual.blocks[i]);
  }
  const Quadratic& quadratic = item.quadratic->quadratic();
  const double weight = item.residual.weight;
  const Eigen::VectorXd d = item.quadratic->Difference(scratch->blocks.data());
  const Eigen::VectorXd curved = quadratic.hessian * d;
  *cost = weight * (quadratic.constant + quadratic.gradient.dot(d) + 0.5 * d.dot(curved));
  if (linearization != nullptr) {
    Eigen::Map<Eigen::VectorXd>(linearization, d.size()) = weight * (quadratic.gradient + curved);
  }
  return std::isfinite(*cost);
}

bool NormalEquations::EvaluateItem(const Item& item,
                                   const DeformationState& state,
                                   double* linearization,
                                   Scratch* scratch,
                                   double* cost) const {
  *cost = 0.0;
  if (item.quadratic != nullptr) {
    return EvaluateQuadratic(item, state, linearization, scratch, cost);
  }
  return item.point != nullptr ? EvaluatePoint(item, state, linearization, scratch, cost)
                               : EvaluateGeneral(item, state, linearization, scratch, cost);
}

}  // namespace ceres_ed
