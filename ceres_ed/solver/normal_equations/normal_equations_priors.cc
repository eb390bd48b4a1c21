// The part of NormalEquations that treats E_reg and E_rot in closed form.
#include <ceres_ed/solver/normal_equations/normal_equations.h>

#include <cmath>

#include <cost_functions/rotation_cost.h>

namespace ceres_ed {
namespace {

using NodeBlock = Eigen::Map<Eigen::Matrix<double, kNodeSize, kNodeSize>>;

}  // namespace

// Adds a residual of E_reg (Eq. 6): r = s [A_j e + t_j - t_k - e] with s = sqrt(alpha_jk) and e =
// g_k - g_j. The Jacobian with respect to node j is s [e; 1]^T (x) I, and that with respect to t_k
// is -s I.
bool NormalEquations::AddEdge(const Edge& edge,
                              const DeformationState& state,
                              const Sums& sums,
                              double* cost) const {
  Eigen::Vector3d r;
  (*edge.cost)(state.node(edge.nodes[0]), state.node(edge.nodes[1]), r.data());
  const double squared_norm = r.squaredNorm();
  *cost += 0.5 * edge.weight * squared_norm;
  if (!std::isfinite(squared_norm)) return false;
  if (sums.gradient == nullptr) return true;
  const double s = edge.cost->sqrt_alpha_jk();
  const Eigen::Vector3d& e = edge.cost->edge();
  const double lever[] = {e.x(), e.y(), e.z(), 1.0};
  const Eigen::Vector3d scaled = edge.weight * s * r;
  const double curvature = edge.weight * s * s;
  const bool with_values = sums.values != nullptr;
  if (edge.blocks[0] >= 0) {
    double* g = Gradient(edge.first_slot, sums);
    for (int i = 0; i < 4; ++i) {
      for (int c = 0; c < 3; ++c) g[3 * i + c] += lever[i] * scaled[c];
    }
  }
  if (edge.blocks[1] >= 0) {
    double* g = Gradient(edge.first_slot + 2, sums) + kNodeTranslationOffset;
    for (int c = 0; c < 3; ++c) g[c] -= scaled[c];
  }
  if (!with_values) return true;
  if (edge.blocks[0] >= 0) {
    NodeBlock H(Values(edge.first_slot, sums));
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        const double product = curvature * lever[i] * lever[j];
        for (int c = 0; c < 3; ++c) H(3 * i + c, 3 * j + c) += product;
      }
    }
  }
  if (edge.blocks[1] >= 0) {
    NodeBlock H(Values(edge.first_slot + 2, sums));
    for (int c = kNodeTranslationOffset; c < kNodeSize; ++c) H(c, c) += curvature;
  }
  if (edge.blocks[0] < 0 || edge.blocks[1] < 0) return true;
  NodeBlock H(Values(edge.first_slot + 1, sums));
  const bool first_is_row = edge.blocks[0] > edge.blocks[1];
  for (int i = 0; i < 4; ++i) {
    for (int c = 0; c < 3; ++c) {
      const int own = 3 * i + c;
      const int other = kNodeTranslationOffset + c;
      (first_is_row ? H(own, other) : H(other, own)) -= curvature * lever[i];
    }
  }
  return true;
}

// Adds the residuals of E_rot (Eq. 4, 5) of one node. With A = [c1 c2 c3], r_ij = ci.cj for i < j
// and r_ii = ci.ci - 1. The derivative of r_ij with respect to ci is cj, and that of r_ii is 2 ci.
bool NormalEquations::AddRotation(const Rotation& rotation,
                                  const DeformationState& state,
                                  const Sums& sums,
                                  double* cost) const {
  const Eigen::Matrix3d A = NodeAffine(state.node(rotation.node));
  Eigen::Matrix3d r = A.transpose() * A;
  r.diagonal().array() -= 1.0;
  const double squared_norm = 0.5 * (r.squaredNorm() + r.diagonal().squaredNorm());
  *cost += 0.5 * rotation.weight * squared_norm;
  if (!std::isfinite(squared_norm)) return false;
  if (sums.gradient == nullptr || rotation.block < 0) return true;
  Eigen::Matrix3d gradient = A * r;
  for (int c = 0; c < 3; ++c) gradient.col(c) += r(c, c) * A.col(c);
  Eigen::Map<Eigen::Matrix3d>(Gradient(rotation.slot, sums)) += rotation.weight * gradient;
  if (sums.values == nullptr) return true;
  NodeBlock H(Values(rotation.slot, sums));
  const Eigen::Matrix3d all = A * A.transpose();
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      Eigen::Matrix3d product = A.col(j) * A.col(i).transpose();
      // The sum over the other columns, and four times the product of the column itself.
      if (i == j) product = all + 3.0 * product;
      H.block<3, 3>(3 * i, 3 * j) += rotation.weight * product;
    }
  }
  return true;
}

}  // namespace ceres_ed
