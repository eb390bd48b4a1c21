// Sums of products over warped points that the same nodes carry.
#ifndef CERES_ED_SOLVER_NORMAL_EQUATIONS_GROUP_PRODUCTS_H_
#define CERES_ED_SOLVER_NORMAL_EQUATIONS_GROUP_PRODUCTS_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {

// The Jacobian of a point's residuals by its node a is w_a [v - g_a; 1]^T (x) D with D = dr/dp,
// that by the camera see AddCameraBlock. With h = [v - g_0; 1], g_0 any place near the nodes, all
// levers [v - g_a; 1] are h plus a constant, so that of all points of a group only
//   sum w_a w_b (h h^T) (x) M,  M = D^T D
// is wanted: 10 x 6 numbers a pair of nodes in place of the 144 of a block.
struct GroupSums {
  static constexpr int kMaxPairs = kMaxBoundNodes * (kMaxBoundNodes + 1) / 2;
  // A row of products, filled up to a whole number of vectors.
  static constexpr int kRow = 64;
  static constexpr int kLevers = 10;
  static constexpr int kMoments = 6;
  static constexpr int kCameraMoments = 15;

  // Of nodes a >= b in row a (a + 1) / 2 + b: [lever pair][entry of M], lower triangles row by row.
  alignas(64) double pairs[kMaxPairs][kRow];
  // Of node a and the camera: for each entry of h, M and then [p]_x M by rows.
  alignas(64) double camera_nodes[kMaxBoundNodes][kRow];
  // Of node a: for each entry of h, v = D^T r.
  double gradients[kMaxBoundNodes][12];
  // [p]_x M [p]_x^T in full.
  Eigen::Matrix3d turn_turn;
  // [p]_x M, M, [p]_x v and v.
  Eigen::Matrix3d turn_shift;
  Eigen::Matrix3d shift_shift;
  Eigen::Vector3d turn_gradient;
  Eigen::Vector3d shift_gradient;

  void SetZero(int num_nodes);
};

// Points of a group, linearised. M and v are those of the map frame.
struct LinearizedPoints {
  int count = 0;
  int num_nodes = 0;
  // h without its 1, three a point.
  const double* levers = nullptr;
  // num_nodes a point.
  const double* weights = nullptr;
  // Lower triangle of M row by row, six a point.
  const double* moments = nullptr;
  // v, three a point.
  const double* gradients = nullptr;
  // p, three a point; null where the camera is held or not there.
  const double* warped = nullptr;
};

// Where nodes take points: out = sum_a weights[a] (A_a h + c_a), three numbers each of `count`
// points, with [A_a c_a] column-major in `nodes`, 12 each.
void WarpPoints(int count,
                int num_nodes,
                const double* levers,
                const double* weights,
                const double* nodes,
                double* out);

// Adds to the gradients.
void AddGroupGradients(const LinearizedPoints& points, GroupSums* sums);
// Adds to all else.
void AddGroupProducts(const LinearizedPoints& points, GroupSums* sums);

// out += the block of two nodes whose levers are h + [row_shift; 0] and h + [column_shift; 0].
// Column-major, 12 x 12.
void AddPairBlock(const double* sums,
                  const double* row_shift,
                  const double* column_shift,
                  double* out);

// out += the block of a node (columns) and the camera (rows), column-major, 6 x 12: C^T D^T D_a
// with C = [-2 [R_c p]_x, I] the derivative of the point in the camera frame by the camera's
// tangent.
void AddCameraBlock(const double* sums,
                    const double* column_shift,
                    const Eigen::Matrix3d& R_c,
                    double* out);

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_NORMAL_EQUATIONS_GROUP_PRODUCTS_H_
