// The map: points at rest, the graph that deforms them, and its present deformation.
#ifndef CERES_ED_SLAM_MAP_DEFORMABLE_MAP_H_
#define CERES_ED_SLAM_MAP_DEFORMABLE_MAP_H_

#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/slam/map/map_points.h>
#include <ceres_ed/slam/map/node_index.h>
#include <ceres_ed/slam/map/view_volume.h>
#include <ceres_ed/slam/slam_types.h>

#include <deque>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

class CheckpointArchive;

// The warp of a point with a fixed binding: v~ = gradient v + offset, in the map frame.
struct LocalWarp {
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Identity();
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& at_rest) const {
    return gradient * at_rest + offset;
  }
  // Returns whether the warp is far enough from folding to be inverted.
  bool IsInvertible() const;
  // Returns the rest position of a point that is at `now`. The warp must be invertible.
  Eigen::Vector3d AtRest(const Eigen::Vector3d& now) const;
};

// The points and nodes of a map, both with stable indices. Each point is stored with its strongest
// node, and nodes are indexed by their position. The parts near the view are therefore found
// without visiting the whole map, and no existing data are copied when the map grows.
class DeformableMap {
 public:
  // A point is bound to `neighbors` nodes (m of Eq. 2), in [1, kMaxBoundNodes].
  explicit DeformableMap(int neighbors = 4) : points_(neighbors) {}

  int neighbors() const { return points_.neighbors(); }
  const DeformationGraph& graph() const { return graph_; }
  const DeformationState& state() const { return state_; }
  void SetCamera(const CameraPose& camera_from_map) { state_.camera_from_map = camera_from_map; }

  // Returns the number of slots for points, used or not.
  int num_slots() const { return points_.size(); }
  int num_points() const { return num_points_; }
  // Returns whether a slot is used.
  bool alive(int slot) const { return points_.id(slot) >= 0; }
  MapPoint point(int slot) const { return points_[slot]; }
  void SetPoint(int slot, const MapPoint& point) { points_.Set(slot, point); }
  PointBinding binding(int slot) const { return points_.binding(slot); }
  // Returns the slots of the points whose strongest node this is.
  const std::vector<int>& points_of_node(int node) const { return points_of_node_[node]; }

  // Adds a node and returns its index. Its state follows from `affine` and its present position
  // `now`.
  int AddNode(const Eigen::Vector3d& at_rest,
              const Eigen::Vector3d& now,
              const Eigen::Matrix3d& affine);
  // Adds an edge of weight 1 in each direction.
  void Connect(int a, int b);
  // Sets the weight of an edge, >= 0.
  void SetEdgeWeight(int edge, double weight) { graph_.SetEdgeWeight(edge, weight); }
  // Sets A_j and t_j of an existing node, in the layout of node_parameters.h.
  void SetNode(int node, const double* parameters);

  // Adds a point and returns its slot. The point gets the next unused identifier.
  int AddPoint(MapPoint point, const Binding& binding);
  // Binds a point to other nodes. As in AddPoint(), the weights are rounded (MapPoints::Kept).
  void Rebind(int slot, const Binding& binding);
  // Removes a point; its slot may be used again.
  void RemovePoint(int slot);

  // Returns the expected translation t_j of a node; for a new node, the one that it was created
  // with.
  const Eigen::Vector3d& node_prior(int node) const { return node_prior_[node]; }
  void SetNodePrior(int node, const Eigen::Vector3d& translation) {
    node_prior_[node] = translation;
  }

  // Returns the present position of node j, g_j + t_j.
  Eigen::Vector3d NodePosition(int node) const;
  // Returns the present warp of points with this binding (Eq. 1 without the camera).
  LocalWarp WarpOf(const Binding& binding) const;
  // Returns the same with the nearest rotation as gradient, about the bound nodes: the warp without
  // its strain.
  LocalWarp RigidWarpOf(const Binding& binding) const;

  // Returns the nodes, in ascending order, to which points in the view may be bound, and few
  // others.
  std::vector<int> NodesNearView(const ViewVolume& view) const;

  // Adds the memory that the map occupies to the fields of `memory`.
  void AddMemory(MapMemory* memory) const;

  // Saves the whole map, or loads it and replaces the present one.
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
