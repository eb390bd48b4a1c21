// The map: points at rest, the graph that carries them, and its present deformation.
#ifndef CERES_ED_SLAM_DEFORMABLE_MAP_H_
#define CERES_ED_SLAM_DEFORMABLE_MAP_H_

#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/skinning.h>
#include <ceres_ed/slam/node_index.h>
#include <ceres_ed/slam/view_volume.h>

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

class CheckpointArchive;

// What the map knows of one point. Lengths are in map units.
struct MapPoint {
  // Where it is while all nodes are at rest.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  // Unit length, at rest.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  // Number of observations in the running average.
  double weight = 0.0;
  std::array<std::uint8_t, 3> color = {200, 200, 200};
  // Never reused.
  int id = -1;
  int birth_frame = -1;
  // In the camera frame of that frame.
  Eigen::Vector3d birth_position = Eigen::Vector3d::Zero();
  // Frames in which the camera saw through it, less those in which it saw it.
  int contradictions = 0;
};

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
  explicit DeformableMap(int neighbors = 4) : neighbors_(neighbors), skinning_(neighbors) {}

  int neighbors() const { return neighbors_; }
  const DeformationGraph& graph() const { return graph_; }
  const DeformationState& state() const { return state_; }
  void SetCamera(const CameraPose& camera_from_map) { state_.camera_from_map = camera_from_map; }

  // Slots of points, in use or not.
  int num_slots() const { return static_cast<int>(points_.size()); }
  int num_points() const { return num_points_; }
  bool alive(int slot) const { return points_[slot].id >= 0; }
  const MapPoint& point(int slot) const { return points_[slot]; }
  MapPoint& mutable_point(int slot) { return points_[slot]; }
  Binding binding(int slot) const { return skinning_[slot]; }
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
  // Gives a point to other nodes.
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

  // Saves everything, or loads it in the place of what is there.
  void Exchange(CheckpointArchive* archive);

 private:
  void Detach(int slot);
  void ExchangeGraph(CheckpointArchive* archive);
  void ExchangePoints(CheckpointArchive* archive);

  int neighbors_;
  DeformationGraph graph_;
  DeformationState state_;
  Skinning skinning_;
  NodeIndex index_;
  std::deque<Eigen::Vector3d> node_prior_;
  std::deque<MapPoint> points_;
  std::vector<int> free_slots_;
  std::deque<std::vector<int>> points_of_node_;
  int num_points_ = 0;
  int next_id_ = 0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_DEFORMABLE_MAP_H_
