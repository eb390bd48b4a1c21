#include "ceres_ed/graph/inverse_warp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr int kStarts = 8;
constexpr int kMaxSteps = 20;
// A step is halved until it is below this share of its length.
constexpr double kSmallestShare = 1.0 / 16;
// How often a step across a kink may make the residual worse.
constexpr int kMaxCrossings = 2;
// A step is taken if the residual falls by this share of what a linear map would give.
constexpr double kMinDescent = 1e-3;
// A matrix whose determinant is below this share of the cube of its norm has no inverse.
constexpr double kMinDeterminant = 1e-9;

bool IsInvertible(const Eigen::Matrix3d& matrix) {
  const double norm = matrix.norm();
  return std::abs(matrix.determinant()) > kMinDeterminant * norm * norm * norm &&
         matrix.inverse().allFinite();
}

// The warp at a point of the search.
struct Trial {
  Trial(const SpaceWarp& warp, const Eigen::Vector3d& point, const Eigen::Vector3d& y) : x(point) {
    // A warp with huge numbers may lead out of the range of double.
    if (!point.allFinite()) return;
    missing = y - warp.Evaluate(point, &gradient);
    if (missing.allFinite()) residual = missing.norm();
  }

  bool IsRegular() const { return IsInvertible(gradient); }
  // Whether the residual is below that of `other` after a step of this share.
  bool IsBetterThan(const Trial& other, double share) const {
    return residual <= (1.0 - kMinDescent * share) * other.residual;
  }
  InversePoint AsPoint() const { return {x, residual, !(gradient.determinant() > 0.0)}; }

  Eigen::Vector3d x;
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  Eigen::Vector3d missing = Eigen::Vector3d::Zero();
  double residual = std::numeric_limits<double>::infinity();
};

}  // namespace

InverseWarp::InverseWarp(const SpaceWarp& warp, double tolerance)
    : warp_(warp), tolerance_(tolerance), tree_(moved_nodes_) {
  CHECK_GT(tolerance, 0.0);
  for (const Eigen::Vector3d& g : warp.warp().graph.positions()) {
    Eigen::Matrix3d gradient;
    moved_nodes_.push_back(warp.Evaluate(g, &gradient));
    inverse_gradients_.emplace_back(Eigen::Matrix3d::Zero());
    if (IsInvertible(gradient)) inverse_gradients_.back() = gradient.inverse();
  }
  tree_ = KdTree(moved_nodes_);
}

InversePoint InverseWarp::Find(const Eigen::Vector3d& y) const {
  std::array<Neighbor, kStarts> nearest;
  const int count = tree_.KNearest(y, kStarts, nearest.data());
  // No node is found if the squares of all distances leave the range of double.
  InversePoint best;
  for (int i = 0; i < count; ++i) {
    const int j = nearest[i].index;
    const Eigen::Vector3d step = inverse_gradients_[j] * (y - moved_nodes_[j]);
    InversePoint found = Descend(warp_.warp().graph.position(j) + step, y);
    const bool found_ends = found.residual <= tolerance_;
    const bool best_ends = i > 0 && best.residual <= tolerance_;
    if (found_ends && !found.is_folded) return found;
    if (i == 0 || (!best_ends && found.residual < best.residual)) best = found;
  }
  return best;
}

InversePoint InverseWarp::Descend(const Eigen::Vector3d& start, const Eigen::Vector3d& y) const {
  Trial at(warp_, start, y);
  InversePoint best = at.AsPoint();
  int crossings = 0;
  for (int i = 0; i < kMaxSteps && best.residual > tolerance_ && at.IsRegular(); ++i) {
    const Eigen::Vector3d step = at.gradient.inverse() * at.missing;
    double share = 1.0;
    Trial next(warp_, at.x + step, y);
    while (share > kSmallestShare && !next.IsBetterThan(at, share)) {
      share *= 0.5;
      next = Trial(warp_, at.x + share * step, y);
    }
    // Beside a kink of the warp, the step leads to where the gradient is another one. A small step
    // across makes that known.
    if (!next.IsBetterThan(at, share) && ++crossings > kMaxCrossings) break;
    at = next;
    if (at.residual < best.residual) best = at.AsPoint();
  }
  return best;
}

}  // namespace ceres_ed
