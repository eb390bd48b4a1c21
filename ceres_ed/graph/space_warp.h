// A warp as a map of space: the value and the derivative at any point.
#ifndef CERES_ED_GRAPH_SPACE_WARP_H_
#define CERES_ED_GRAPH_SPACE_WARP_H_

#include <ceres_ed/graph/point_binder.h>
#include <ceres_ed/graph/vertex_field.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/util/status.h>

#include <memory>

#include <Eigen/Core>

namespace ceres_ed {

// Evaluates a warp at points in space, with the values that ApplyWarp() gives to the points of a
// cloud without triangles:
//   W(x) = s R (sum_j w_j(x) [A_j (x - g_j) + g_j + t_j] + f(x)) + T
// where the nodes j are those nearest in space. (A mesh is bound along its surface, so its vertices
// may move differently where parts that are far apart on the surface are near in space.) The search
// trees are built once. Any number of threads may evaluate at the same time.
//
// W is continuous where the graph has no nodes inside a body and no finish. Its derivative jumps
// where the set of the nearest nodes changes. A finish f, and the choice of nodes inside a body,
// add small jumps between the regions of their nearest points.
class SpaceWarp {
 public:
  // Copies what it needs of `warp`. Returns an error for a warp without nodes, with parts of
  // different sizes, or that moves a node to infinity. `num_threads` >= 1 is for the preparation.
  static StatusOr<std::unique_ptr<const SpaceWarp>> Create(const Warp& warp, int num_threads = 1);

  const Warp& warp() const { return warp_; }

  // Returns W(x), a point in the frame of the target. `x` is a finite point in the frame of the
  // source.
  Eigen::Vector3d operator()(const Eigen::Vector3d& x) const;

  // Does the same and writes dW/dx to `gradient`: entry (r, c) is the derivative of coordinate r by
  // x_c. Unlike WarpGradient(), it includes the derivatives of the weights and of the finish.
  Eigen::Vector3d Evaluate(const Eigen::Vector3d& x, Eigen::Matrix3d* gradient) const;

 private:
  SpaceWarp(const Warp& warp, int num_threads);

  const Warp warp_;
  const PointBinder binder_;
  const VertexFieldSampler finish_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_SPACE_WARP_H_
