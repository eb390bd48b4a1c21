#include "ceres_ed/graph/space_warp.h"

#include <limits>
#include <string>

namespace ceres_ed {
namespace {

// Returns d|x - g| / dx; zero at g, where it does not exist.
Eigen::Vector3d DistanceGradient(const Eigen::Vector3d& x,
                                 const Eigen::Vector3d& g,
                                 double distance) {
  if (distance == 0.0) return Eigen::Vector3d::Zero();
  return (x - g) / distance;
}

// Returns sum_j y_j (dw_j/dx)^T, where y_j is the point as node j moves it and w_j are the weights
// of Eq. 2. With u_j = 1 - d_j / D:
//   w_j = u_j / sum_k u_k,   du_j = (d_j / D dD - dd_j) / D,   dw_j = (du_j - w_j sum_k du_k) /
//   sum_k u_k
// The weights sum to 1, so `mean` = sum_j w_j y_j may be subtracted from each y_j.
Eigen::Matrix3d GradientThroughWeights(const Warp& warp,
                                       int neighbors,
                                       const NearNodes& near,
                                       const BoundNodes& bound,
                                       const Eigen::Vector3d& x,
                                       const Eigen::Vector3d& mean) {
  const bool has_spare = near.size > neighbors;
  const int last = has_spare ? neighbors : near.size - 1;
  const double reach = has_spare ? 1.0 : 1.0 + 1.0 / near.size;
  const double D = reach * near.distances[last];
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  if (!(D > 0.0)) return sum;
  const auto gradient_of = [&](int i) {
    return DistanceGradient(x, warp.graph.position(near.nodes[i]), near.distances[i]);
  };
  const Eigen::Vector3d dD = reach * gradient_of(last);
  double sum_of_u = 0.0;
  for (int i = 0; i < bound.size; ++i) {
    const double ratio = near.distances[i] / D;
    const double* node = warp.state.node(near.nodes[i]);
    const Eigen::Vector3d& g = warp.graph.position(near.nodes[i]);
    const Eigen::Vector3d y = NodeAffine(node) * (x - g) + g + NodeTranslation(node);
    sum += (y - mean) * ((ratio * dD - gradient_of(i)) / D).transpose();
    sum_of_u += 1.0 - ratio;
  }
  // All nodes are equally far: the weights are equal, and constant to first order.
  if (!(sum_of_u > std::numeric_limits<double>::epsilon())) return Eigen::Matrix3d::Zero();
  return sum / sum_of_u;
}

Status CheckParts(const Warp& warp) {
  std::string error;
  if (!warp.binding.IsValid(&error)) return Status::Error("bad binding: " + error);
  // The checks of ApplyWarp().
  PointCloud nothing;
  return ApplyWarp(warp, &nothing);
}

}  // namespace

StatusOr<std::unique_ptr<const SpaceWarp>> SpaceWarp::Create(const Warp& warp, int num_threads) {
  if (Status status = CheckParts(warp); !status.ok()) return status;
  std::unique_ptr<const SpaceWarp> created(new SpaceWarp(warp, num_threads));
  for (int j = 0; j < warp.graph.num_nodes(); ++j) {
    if ((*created)(warp.graph.position(j)).allFinite()) continue;
    return Status::Error("the warp moves node " + std::to_string(j) +
                         " to a point that is not finite");
  }
  return created;
}

SpaceWarp::SpaceWarp(const Warp& warp, int num_threads)
    : warp_(warp),
      binder_(PointBinder::InSpace(warp.graph, warp.binding.neighbors)),
      finish_(warp.finish, std::numeric_limits<std::size_t>::max(), num_threads) {}

Eigen::Vector3d SpaceWarp::operator()(const Eigen::Vector3d& x) const {
  const BoundNodes bound = binder_.Bind(x);
  Eigen::Vector3d moved = WarpPoint(warp_.graph, warp_.state, bound.binding(), x);
  if (!warp_.finish.empty()) moved += finish_.At(x);
  return warp_.target_from_source * moved;
}

Eigen::Vector3d SpaceWarp::Evaluate(const Eigen::Vector3d& x, Eigen::Matrix3d* gradient) const {
  const NearNodes near = binder_.Near(x);
  const BoundNodes bound = binder_.Bind(near);
  Eigen::Vector3d moved = WarpPoint(warp_.graph, warp_.state, bound.binding(), x);
  *gradient = WarpGradient(warp_.state, bound.binding()) +
              GradientThroughWeights(warp_, binder_.neighbors(), near, bound, x, moved);
  if (!warp_.finish.empty()) {
    Eigen::Matrix3d of_finish;
    moved += finish_.At(x, &of_finish);
    *gradient += of_finish;
  }
  *gradient = warp_.target_from_source.scale *
              warp_.target_from_source.rotation.toRotationMatrix() * *gradient;
  return warp_.target_from_source * moved;
}

}  // namespace ceres_ed
