#include "ceres_ed/report/view/warp_motion.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/graph/vertex_field.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/SVD>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {
namespace {

// Returns the motion of a node: A = R S with the nearest proper rotation R.
NodeMotion SplitNode(const Eigen::Vector3d& position, const double* node) {
  NodeMotion motion;
  motion.position = position;
  motion.translation = NodeTranslation(node);
  const Eigen::Matrix3d affine = NodeAffine(node);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(affine, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d rotation = svd.matrixU() * svd.matrixV().transpose();
  if (rotation.determinant() < 0.0) {
    Eigen::Matrix3d flipped = svd.matrixU();
    flipped.col(2) *= -1.0;
    rotation = flipped * svd.matrixV().transpose();
  }
  motion.rotation = Eigen::Quaterniond(rotation).normalized();
  motion.stretch = motion.rotation.toRotationMatrix().transpose() * affine;
  return motion;
}

Eigen::Matrix3d AffineAt(const NodeMotion& node, double bent) {
  const Eigen::Quaterniond turned = Eigen::Quaterniond::Identity().slerp(bent, node.rotation);
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  return turned.toRotationMatrix() * (identity + bent * (node.stretch - identity));
}

Eigen::Vector3d Place(const WarpMotion& motion, const Eigen::Vector3d& point, double placed) {
  const Similarity& end = motion.target_from_source;
  const Eigen::Quaterniond turned = Eigen::Quaterniond::Identity().slerp(placed, end.rotation);
  const double scale = std::pow(end.scale, placed);
  const Eigen::Vector3d center = motion.center + placed * (end * motion.center - motion.center);
  return scale * (turned * (point - motion.center)) + center;
}

}  // namespace

Eigen::Vector3d WarpMotion::Move(const Eigen::Vector3d& point,
                                 int index,
                                 const MotionParts& parts) const {
  Eigen::Vector3d moved = nodes.empty() ? point : Eigen::Vector3d::Zero();
  for (int k = 0; k < stride; ++k) {
    const std::size_t at = static_cast<std::size_t>(index) * stride + k;
    if (!(weights[at] > 0.0)) continue;
    const NodeMotion& node = nodes[bound[at]];
    moved += weights[at] * (AffineAt(node, parts.bent) * (point - node.position) + node.position +
                            parts.bent * node.translation);
  }
  if (!finish.empty()) moved += parts.bent * finish[index];
  return Place(*this, moved, parts.placed);
}

Eigen::Vector3d WarpMotion::MoveNode(int node, const MotionParts& parts) const {
  return Place(*this, nodes[node].position + parts.bent * nodes[node].translation, parts.placed);
}

double WarpMotion::PlacementShare(const std::vector<Eigen::Vector3d>& points,
                                  double diagonal) const {
  constexpr double kVisible = 1e-3;
  constexpr double kShare = 0.4;
  double farthest = 0.0;
  for (const Eigen::Vector3d& point : points) {
    farthest = std::max(farthest, (target_from_source * point - point).norm());
  }
  return farthest > kVisible * diagonal ? kShare : 0.0;
}

MotionParts PartsAt(double at, double share) {
  MotionParts parts;
  parts.placed = share > 0.0 ? std::clamp(at / share, 0.0, 1.0) : 1.0;
  parts.bent = std::clamp((at - share) / (1.0 - share), 0.0, 1.0);
  return parts;
}

WarpMotion MakeWarpMotion(const Warp& warp,
                          const Skinning& skinning,
                          const std::vector<Eigen::Vector3d>& points,
                          const std::vector<int>& kept) {
  WarpMotion motion;
  motion.target_from_source = warp.target_from_source;
  motion.center = points.empty() ? Eigen::Vector3d::Zero() : BoundingBox(points).center().eval();
  for (int j = 0; j < warp.graph.num_nodes(); ++j) {
    motion.nodes.push_back(SplitNode(warp.graph.position(j), warp.state.node(j)));
  }
  motion.stride = skinning.stride();
  motion.bound.assign(kept.size() * motion.stride, 0);
  motion.weights.assign(kept.size() * motion.stride, 0.0);
  std::vector<Eigen::Vector3d> queries;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const Binding binding = skinning[kept[i]];
    for (int k = 0; k < binding.size; ++k) {
      motion.bound[i * motion.stride + k] = binding.nodes[k];
      motion.weights[i * motion.stride + k] = binding.weights[k];
    }
    queries.push_back(points[kept[i]]);
  }
  if (!warp.finish.empty()) motion.finish = EvaluateField(warp.finish, queries);
  return motion;
}

WarpMotion StraightMotion(const std::vector<Eigen::Vector3d>& from,
                          const std::vector<Eigen::Vector3d>& to) {
  WarpMotion motion;
  motion.center = from.empty() ? Eigen::Vector3d::Zero() : BoundingBox(from).center().eval();
  for (std::size_t i = 0; i < from.size(); ++i) motion.finish.push_back(to[i] - from[i]);
  return motion;
}

}  // namespace ceres_ed
