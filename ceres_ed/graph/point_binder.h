// The binding of single points in space to the nodes near them.
#ifndef CERES_ED_GRAPH_POINT_BINDER_H_
#define CERES_ED_GRAPH_POINT_BINDER_H_

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/skinning.h>

#include <array>
#include <vector>

#include <Eigen/Core>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {

// The nodes that decide about the weights of a point (Eq. 2): those that may carry it and one more,
// in ascending order of their distances.
struct NearNodes {
  std::array<int, kMaxBoundNodes + 1> nodes;
  std::array<double, kMaxBoundNodes + 1> distances;
  int size = 0;
};

// The nodes and weights of one point, before they are added to a Skinning.
struct BoundNodes {
  std::array<int, kMaxBoundNodes> nodes;
  std::array<double, kMaxBoundNodes> weights;
  int size = 0;

  // Refers to this object, which must outlive the result.
  Binding binding() const { return {nodes.data(), weights.data(), size}; }
};

// Binds points to nodes by distances in space. Any number of threads may use it at the same time.
class PointBinder {
 public:
  // Binds each point to the `neighbors` nodes nearest to it, in [1, kMaxBoundNodes]. There must be
  // a node.
  PointBinder(std::vector<Eigen::Vector3d> node_positions, int neighbors);

  // Returns what binds points as BindCloudToGraph() binds a cloud without triangles: InBody() if
  // the graph has nodes inside a body, else to the `neighbors` nearest nodes of the surface.
  static PointBinder InSpace(const DeformationGraph& graph, int neighbors);

  // Returns what binds points as BindInBody() does: to the kMaxBoundNodes nearest of those nodes
  // that are at most three edges away from the nearest one.
  static PointBinder InBody(const DeformationGraph& graph);

  // It refers to its own members.
  PointBinder(const PointBinder&) = delete;
  PointBinder& operator=(const PointBinder&) = delete;

  // m of Eq. 2: the largest number of nodes to which a point is bound.
  int neighbors() const { return neighbors_; }
  // Returns no nodes for a point that is not finite.
  NearNodes Near(const Eigen::Vector3d& point) const;
  // Binds a point to the nodes that Near() has found for it, one at least.
  BoundNodes Bind(const NearNodes& near) const;
  BoundNodes Bind(const Eigen::Vector3d& point) const { return Bind(Near(point)); }

 private:
  explicit PointBinder(const DeformationGraph& graph);
  NearNodes NearInBody(const Eigen::Vector3d& point) const;

  const int neighbors_;
  const std::vector<Eigen::Vector3d> positions_;
  const KdTree tree_;
  // For a body: the nodes within a few edges of each node, in ascending order. Else empty.
  const std::vector<std::vector<int>> linked_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_POINT_BINDER_H_
