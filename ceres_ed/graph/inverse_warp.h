// The inverse of a warp, point by point.
#ifndef CERES_ED_GRAPH_INVERSE_WARP_H_
#define CERES_ED_GRAPH_INVERSE_WARP_H_

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/graph/space_warp.h>

#include <limits>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The point x that comes nearest to W(x) = y.
struct InversePoint {
  // x, in the frame of the source.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  // |W(x) - y|, in the unit of the target; infinite if nothing was found.
  double residual = std::numeric_limits<double>::infinity();
  // Whether the warp turns space inside out at x: det(dW/dx) <= 0. There the warp is folded, and
  // other points are moved to y, too.
  bool is_folded = false;
};

// Inverts a warp by damped Newton steps. The search begins at the node that the warp moves nearest
// to y, carried on by the gradient there; if it fails or ends in a fold, it begins again at the
// next nearest ones. Any number of threads may search at the same time. The result depends on y
// alone.
class InverseWarp {
 public:
  // A search ends when the residual is at most `tolerance` > 0, in the unit of the target. `warp`
  // must outlive this object.
  InverseWarp(const SpaceWarp& warp, double tolerance);
  // It refers to its own members.
  InverseWarp(const InverseWarp&) = delete;
  InverseWarp& operator=(const InverseWarp&) = delete;

  // Returns the best point that was found for `y`, a finite point in the frame of the target. The
  // caller judges the residual: where the warp reaches no point near y, it is large.
  InversePoint Find(const Eigen::Vector3d& y) const;

 private:
  InversePoint Descend(const Eigen::Vector3d& start, const Eigen::Vector3d& y) const;

  const SpaceWarp& warp_;
  const double tolerance_;
  // The nodes as the warp moves them, and the inverse of its gradient at each of them; zero where
  // it has none.
  std::vector<Eigen::Vector3d> moved_nodes_;
  std::vector<Eigen::Matrix3d> inverse_gradients_;
  KdTree tree_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_INVERSE_WARP_H_
