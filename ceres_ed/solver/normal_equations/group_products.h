// Sums of products over warped points that are bound to the same nodes.
#ifndef CERES_ED_SOLVER_NORMAL_EQUATIONS_GROUP_PRODUCTS_H_
#define CERES_ED_SOLVER_NORMAL_EQUATIONS_GROUP_PRODUCTS_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {

// The sums over one group of points from which all its blocks of the normal equations are computed.
//
// The Jacobian of a point's residuals with respect to its node a is w_a [v - g_a; 1]^T (x) D with D
// = dr/dp; for the camera see AddCameraBlock(). Let h = [v - g_0; 1], where g_0 is any place near
// the nodes. Then every lever [v - g_a; 1] is h plus a constant, so that the blocks of two nodes
// follow from the sums
//   sum w_a w_b (h h^T) (x) M,  M = D^T D
// over the points of the group: 10 x 6 numbers per pair of nodes instead of the 144 of a block.
struct GroupSums {
  static constexpr int kMaxPairs = kMaxBoundNodes * (kMaxBoundNodes + 1) / 2;
  // The length of a row of products, padded to a whole number of SIMD vectors.
  static constexpr int kRow = 64;
  static constexpr int kLevers = 10;
  static constexpr int kMoments = 6;
  static constexpr int kCameraMoments = 15;

  // For nodes a >= b, in row a (a + 1) / 2 + b: [pair of lever entries][entry of M], where both are
  // lower triangles stored row by row.
  alignas(64) double pairs[kMaxPairs][kRow];
  // For node a and the camera: for each entry of h, the entries of M and then those of [p]_x M by
  // rows.
  alignas(64) double camera_nodes[kMaxBoundNodes][kRow];
  // For node a: for each entry of h, the gradient v = D^T r.
  double gradients[kMaxBoundNodes][12];
  // The full matrix [p]_x M [p]_x^T.
  Eigen::Matrix3d turn_turn;
  // [p]_x M, M, [p]_x v and v.
  Eigen::Matrix3d turn_shift;
  Eigen::Matrix3d shift_shift;
  Eigen::Vector3d turn_gradient;
  Eigen::Vector3d shift_gradient;

  void SetZero(int num_nodes);
};

// The points of a group after linearisation. M and v are in the map frame.
struct LinearizedPoints {
  int count = 0;
  int num_nodes = 0;
  // h without its last entry 1, three values per point.
  const double* levers = nullptr;
  // The weights of the nodes, num_nodes values per point.
  const double* weights = nullptr;
  // The lower triangle of M row by row, six values per point.
  const double* moments = nullptr;
  // v, three values per point.
  const double* gradients = nullptr;
  // p, three values per point; null if the camera is constant or absent.
  const double* warped = nullptr;
};

// Computes the warped points out = sum_a weights[a] (A_a h + c_a), three values for each of `count`
// points. `nodes` contains [A_a c_a] of each node, column-major, 12 values each.
void WarpPoints(int count,
                int num_nodes,
                const double* levers,
                const double* weights,
                const double* nodes,
                double* out);

// Adds the points to the gradients of `sums`.
void AddGroupGradients(const LinearizedPoints& points, GroupSums* sums);
// Adds the points to all other sums.
void AddGroupProducts(const LinearizedPoints& points, GroupSums* sums);

// Adds to `out` the block of two nodes whose levers are h + [row_shift; 0] and h + [column_shift;
// 0]. The block is column-major, 12 x 12.
void AddPairBlock(const double* sums,
                  const double* row_shift,
                  const double* column_shift,
                  double* out);

// Adds to `out` the block of the camera (rows) and a node (columns), C^T D^T D_a, where C = [-2
// [R_c p]_x, I] is the derivative of the point in the camera frame with respect to the tangent of
// the camera. The block is column-major, 6 x 12.
void AddCameraBlock(const double* sums,
                    const double* column_shift,
                    const Eigen::Matrix3d& R_c,
                    double* out);

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_NORMAL_EQUATIONS_GROUP_PRODUCTS_H_
