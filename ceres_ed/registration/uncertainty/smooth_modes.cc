#include "ceres_ed/registration/uncertainty/smooth_modes.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {
namespace {

constexpr int kDegree = 2;
// Keeps coefficients finite that flat or small observed parts leave open. The squares of
// coordinates in a unit frame are up to a quarter.
constexpr double kRidge = 1e-4;

double Power(double x, int exponent) {
  double power = 1.0;
  for (int i = 0; i < exponent; ++i) power *= x;
  return power;
}

std::vector<std::array<int, 3>> Monomials() {
  std::vector<std::array<int, 3>> monomials;
  for (int degree = 0; degree <= kDegree; ++degree) {
    for (int a = degree; a >= 0; --a) {
      for (int b = degree - a; b >= 0; --b) monomials.push_back({a, b, degree - a - b});
    }
  }
  return monomials;
}

int DegreeOf(const std::array<int, 3>& powers) { return powers[0] + powers[1] + powers[2]; }

// Returns the coefficients of the displacements of the observed nodes: one row for each monomial.
Eigen::MatrixXd FitPolynomial(const std::vector<std::array<int, 3>>& monomials,
                              const DeformationGraph& graph,
                              const DeformationState& state,
                              const std::vector<char>& is_observed) {
  const int size = static_cast<int>(monomials.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(size, size);
  Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(size, 3);
  Eigen::VectorXd values(size);
  double count = 0.0;
  for (int j = 0; j < graph.num_nodes(); ++j) {
    if (is_observed[j] == 0) continue;
    for (int m = 0; m < size; ++m) {
      values[m] = SmoothMode{monomials[m], 0, 0.0}.Value(graph.position(j));
    }
    normal += values * values.transpose();
    moments += values * NodeTranslation(state.node(j)).transpose();
    count += 1.0;
  }
  if (count == 0.0) return moments;
  normal /= count;
  normal.diagonal().array() += kRidge;
  return normal.ldlt().solve(moments / count);
}

// Returns the root mean square over the nine entries of sqrt(F^T F) - I, with F = I + G.
double Strain(const Eigen::Matrix3d& G) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(Eigen::Matrix3d::Identity() + G);
  return (svd.singularValues().array() - 1.0).matrix().norm() / 3.0;
}

}  // namespace

double SmoothMode::Value(const Eigen::Vector3d& x) const {
  return Power(x[0], powers[0]) * Power(x[1], powers[1]) * Power(x[2], powers[2]);
}

Eigen::Vector3d SmoothMode::Gradient(const Eigen::Vector3d& x) const {
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    if (powers[i] == 0) continue;
    SmoothMode lower = *this;
    --lower.powers[i];
    gradient[i] = powers[i] * lower.Value(x);
  }
  return gradient;
}

std::vector<SmoothMode> FindSmoothModes(const DeformationGraph& graph,
                                        const DeformationState& state,
                                        const std::vector<char>& is_observed) {
  const std::vector<std::array<int, 3>> monomials = Monomials();
  const Eigen::MatrixXd coefficients = FitPolynomial(monomials, graph, state, is_observed);
  Eigen::Matrix3d linear = Eigen::Matrix3d::Zero();
  double quadratic = 0.0;
  int num_quadratic = 0;
  for (std::size_t m = 0; m < monomials.size(); ++m) {
    const Eigen::Vector3d coefficient = coefficients.row(static_cast<Eigen::Index>(m)).transpose();
    if (DegreeOf(monomials[m]) == 1) {
      for (int i = 0; i < 3; ++i) {
        if (monomials[m][i] == 1) linear.col(i) = coefficient;
      }
    } else if (DegreeOf(monomials[m]) == 2) {
      quadratic += coefficient.squaredNorm();
      num_quadratic += 3;
    }
  }
  const double amplitudes[] = {Strain(linear), std::sqrt(quadratic / num_quadratic)};
  std::vector<SmoothMode> modes;
  for (const std::array<int, 3>& powers : monomials) {
    const int degree = DegreeOf(powers);
    if (degree == 0) continue;
    for (int axis = 0; axis < 3; ++axis) modes.push_back({powers, axis, amplitudes[degree - 1]});
  }
  return modes;
}

Eigen::VectorXd NodeMotion(const SmoothMode& mode, const DeformationGraph& graph) {
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(kNodeSize * graph.num_nodes());
  for (int j = 0; j < graph.num_nodes(); ++j) {
    double* const node = motion.data() + static_cast<std::ptrdiff_t>(kNodeSize) * j;
    const Eigen::Vector3d& g_j = graph.position(j);
    MutableNodeAffine(node).row(mode.axis) = mode.Gradient(g_j).transpose();
    MutableNodeTranslation(node)[mode.axis] = mode.Value(g_j);
  }
  return motion;
}

}  // namespace ceres_ed
