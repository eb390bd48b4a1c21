// The way of a surface from where it was given to its fitted place, node by node.
#ifndef CERES_ED_REPORT_VIEW_WARP_MOTION_H_
#define CERES_ED_REPORT_VIEW_WARP_MOTION_H_

#include <ceres_ed/graph/warp.h>

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ceres_ed {

// The motion of a node with its affine part A = rotation * stretch, so that it can be followed in
// part: the rotation is turned by a part of its angle, and all else is scaled.
struct NodeMotion {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  // Symmetric.
  Eigen::Matrix3d stretch = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

// How far along its way a surface is, both in [0, 1]: the rigid placement, and the deformation.
struct MotionParts {
  double placed = 1.0;
  double bent = 1.0;
};

// A warp for a set of points, in parts b = `bent` and a = `placed`:
//   v~ = P_a(sum_j w_j [A_j(b) (v - g_j) + g_j + b t_j] + b f)
// where A_j(b) = R_j^b (I + b (S_j - I)), and P_a turns and scales about the centre of the points
// while it moves the centre along a line. For a = b = 1 this is the Warp itself (warp.h). Without
// nodes the sum is v.
struct WarpMotion {
  std::vector<NodeMotion> nodes;
  // The nodes of point i are entries i * stride ... of `bound`; those beyond its number have the
  // weight 0.
  int stride = 0;
  std::vector<int> bound;
  std::vector<double> weights;
  // The displacement f of each point, which is added last; empty if there is none.
  std::vector<Eigen::Vector3d> finish;
  Similarity target_from_source;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();

  // Returns the place of `point`, which is point number `index`.
  Eigen::Vector3d Move(const Eigen::Vector3d& point, int index, const MotionParts& parts) const;

  // Returns the place of a node.
  Eigen::Vector3d MoveNode(int node, const MotionParts& parts) const;

  // Returns the share of the way that goes to the placement, in [0, 0.5]: 0 if it moves no point by
  // more than 0.1 % of `diagonal`, the diagonal of the points, in their unit.
  double PlacementShare(const std::vector<Eigen::Vector3d>& points, double diagonal) const;
};

// Returns where on the way a slider at `at` in [0, 1] is, if `share` of its length is the
// placement.
MotionParts PartsAt(double at, double share);

// Returns the motion of `warp` for the points `kept` (indices) of `points`, which are all points
// that `skinning` binds.
WarpMotion MakeWarpMotion(const Warp& warp,
                          const Skinning& skinning,
                          const std::vector<Eigen::Vector3d>& points,
                          const std::vector<int>& kept);

// Returns a motion along straight lines from `from` to `to`, which have the same size, for lack of
// a warp.
WarpMotion StraightMotion(const std::vector<Eigen::Vector3d>& from,
                          const std::vector<Eigen::Vector3d>& to);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_VIEW_WARP_MOTION_H_
