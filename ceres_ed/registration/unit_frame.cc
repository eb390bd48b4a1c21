#include "ceres_ed/registration/unit_frame.h"

#include <ceres_ed/geometry/bounding_box.h>

namespace ceres_ed {

PointCloud Transformed(const Similarity& pose, const PointCloud& cloud) {
  PointCloud moved = cloud;
  for (Eigen::Vector3d& point : moved.points) point = pose * point;
  for (Eigen::Vector3d& normal : moved.normals) normal = pose.rotation * normal;
  return moved;
}

Similarity UnitFrame(const PointCloud& placed_source) {
  const Eigen::AlignedBox3d box = BoundingBox(placed_source.points);
  Similarity unit_from_target;
  unit_from_target.scale = 1.0 / box.diagonal().norm();
  unit_from_target.translation = -unit_from_target.scale * box.center();
  return unit_from_target;
}

std::vector<Correspondence> InUnitFrame(const std::vector<Landmark>& constraints,
                                        const Similarity& unit_from_target) {
  std::vector<Correspondence> correspondences;
  for (const Landmark& constraint : constraints) {
    Correspondence correspondence;
    correspondence.point = constraint.point;
    correspondence.target = unit_from_target * constraint.position;
    correspondences.push_back(correspondence);
  }
  return correspondences;
}

Similarity GivenFromPlaced(const Similarity& placed,
                           const Similarity& given,
                           const Similarity& unit_from_target) {
  Similarity motion = given * placed.Inverse();
  motion = unit_from_target * motion * unit_from_target.Inverse();
  motion.scale = 1.0;
  return motion;
}

Warp WarpInSourceFrame(const BuiltGraph& graph,
                       const DeformationState& state,
                       const std::vector<Eigen::Vector3d>& source_points,
                       const Similarity& unit_from_source,
                       const Similarity& target_from_source) {
  Warp warp;
  warp.target_from_source = target_from_source;
  warp.binding = graph.binding;
  const Eigen::Matrix3d R = unit_from_source.rotation.toRotationMatrix();
  for (const int point : graph.node_points) warp.graph.AddNode(source_points[point]);
  const Similarity source_from_unit = unit_from_source.Inverse();
  for (int j = graph.graph.num_surface_nodes(); j < graph.graph.num_nodes(); ++j) {
    warp.graph.AddInnerNode(source_from_unit * graph.graph.position(j));
  }
  for (const GraphEdge& edge : graph.graph.edges()) warp.graph.AddEdge(edge);
  warp.state.Resize(graph.graph.num_nodes());
  for (int j = 0; j < graph.graph.num_nodes(); ++j) {
    MutableNodeAffine(warp.state.node(j)) = R.transpose() * NodeAffine(state.node(j)) * R;
    MutableNodeTranslation(warp.state.node(j)) =
        R.transpose() * NodeTranslation(state.node(j)) / unit_from_source.scale;
  }
  return warp;
}

}  // namespace ceres_ed
