// The map: points at rest, the graph that carries them, and its present deformation.
#ifndef CERES_ED_SLAM_MAP_DEFORMABLE_MAP_H_
#define CERES_ED_SLAM_MAP_DEFORMABLE_MAP_H_

#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/slam/map/map_memory.h>
#include <ceres_ed/slam/map/map_points.h>
#include <ceres_ed/slam/map/node_index.h>
#include <ceres_ed/slam/map/view_volume.h>

#include <deque>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

class CheckpointArchive;

// How a frozen binding moves a point: v~ = gradient v + offset, map frame.
struct LocalWarp {
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Identity();
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& at_rest) const {
    return gradient * at_rest + offset;
  }
  // Whether it is far enough from folding to be undone.
  bool IsInvertible() const;
  // Where a point that is at `now` is at rest. Only of an invertible one.
  Eigen::Vector3d AtRest(const Eigen::Vector3d& now) const;
};

// Points and nodes, both with stable indices. A point belongs to its strongest node, and nodes are
// found by place, so that what is in view is found without a walk through the map; nothing that is
// there is copied when the map grows.
class DeformableMap {
 public:
  // `neighbors` nodes carry a point (m of Eq. 2), in [1, kMaxBoundNodes].
  explicit DeformableMap(int neighbors = 4) : points_(neighbors) {}

  int neighbors() const { return points_.neighbors(); }
  const DeformationGraph& graph() const { return graph_; }
  const DeformationState& state() const { return state_; }
  void SetCamera(const CameraPose& camera_from_map) { state_.camera_from_map = camera_from_map; }

  // Slots of points, in use or not.
  int num_slots() const { return points_.size(); }
  int num_points() const { return num_points_; }
  bool alive(int slot) const { return points_.id(slot) >= 0; }
  MapPoint point(int slot) const { return points_[slot]; }
  void SetPoint(int slot, const MapPoint& point) { points_.Set(slot, point); }
  PointBinding binding(int slot) const { return points_.binding(slot); }
  // Points whose strongest node this is.
  const std::vector<int>& points_of_node(int node) const { return points_of_node_[node]; }

  // Returns the new node's index. `affine` and the place where it is now decide its state.
  int AddNode(const Eigen::Vector3d& at_rest,
              const Eigen::Vector3d& now,
              const Eigen::Matrix3d& affine);
  // An edge of weight 1 in either direction.
  void Connect(int a, int b);
  // A_j and t_j of a node that is there, in the layout of node_parameters.h.
  void SetNode(int node, const double* parameters);

  // Returns the slot of a new point; its id is the next one.
  int AddPoint(MapPoint point, const Binding& binding);
  // Gives a point to other nodes. Weights are rounded here as there (MapPoints::Kept).
  void Rebind(int slot, const Binding& binding);
  void RemovePoint(int slot);

  // t_j where a node is thought to be; that of its birth for a new one.
  const Eigen::Vector3d& node_prior(int node) const { return node_prior_[node]; }
  void SetNodePrior(int node, const Eigen::Vector3d& translation) {
    node_prior_[node] = translation;
  }

  // Where node j is now, g_j + t_j.
  Eigen::Vector3d NodePosition(int node) const;
  LocalWarp WarpOf(const Binding& binding) const;
  // The rotation nearest to that, about the bound nodes: the same without its strain.
  LocalWarp RigidWarpOf(const Binding& binding) const;

  // The nodes that may carry something in view, by number, and few others.
  std::vector<int> NodesNearView(const ViewVolume& view) const;

  // Adds what it holds to that of its owners.
  void AddMemory(MapMemory* memory) const;

  // Saves everything, or loads it in the place of what is there.
  void Exchange(CheckpointArchive* archive);

 private:
  void Detach(int slot);
  void ExchangeGraph(CheckpointArchive* archive);
  void ExchangePoints(CheckpointArchive* archive);

  DeformationGraph graph_;
  DeformationState state_;
  NodeIndex index_;
  std::deque<Eigen::Vector3d> node_prior_;
  MapPoints points_;
  std::vector<int> free_slots_;
  std::deque<std::vector<int>> points_of_node_;
  int num_points_ = 0;
  int next_id_ = 0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_MAP_DEFORMABLE_MAP_H_
