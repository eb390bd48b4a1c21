#include "ceres_ed/slam/map/deformable_map.h"

#include <ceres_ed/util/memory_use.h>

#include <algorithm>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cost_functions/node_parameters.h>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

// Points lie within this distance of their strongest node, in map units (node spacings).
constexpr double kReach = 3.0;

}  // namespace

bool LocalWarp::IsInvertible() const {
  constexpr double kMinDeterminant = 0.1;
  return gradient.determinant() > kMinDeterminant;
}

Eigen::Vector3d LocalWarp::AtRest(const Eigen::Vector3d& now) const {
  return gradient.inverse() * (now - offset);
}

int DeformableMap::AddNode(const Eigen::Vector3d& at_rest,
                           const Eigen::Vector3d& now,
                           const Eigen::Matrix3d& affine) {
  const int node = graph_.AddNode(at_rest);
  state_.Resize(node + 1);
  MutableNodeAffine(state_.node(node)) = affine;
  MutableNodeTranslation(state_.node(node)) = now - at_rest;
  points_of_node_.emplace_back();
  node_prior_.push_back(now - at_rest);
  index_.Place(node, now);
  return node;
}

void DeformableMap::Connect(int a, int b) {
  graph_.AddEdge({a, b, 1.0});
  graph_.AddEdge({b, a, 1.0});
}

void DeformableMap::SetNode(int node, const double* parameters) {
  std::copy_n(parameters, kNodeSize, state_.node(node));
  index_.Place(node, NodePosition(node));
}

int DeformableMap::AddPoint(MapPoint point, const Binding& binding) {
  point.id = next_id_++;
  int slot = num_slots();
  if (free_slots_.empty()) {
    points_.Resize(slot + 1);
  } else {
    slot = free_slots_.back();
    free_slots_.pop_back();
  }
  points_.Set(slot, point);
  points_.Bind(slot, binding);
  PushBackTightly(slot, &points_of_node_[binding.nodes[0]]);
  ++num_points_;
  return slot;
}

void DeformableMap::Rebind(int slot, const Binding& binding) {
  Detach(slot);
  points_.Bind(slot, binding);
  PushBackTightly(slot, &points_of_node_[binding.nodes[0]]);
}

void DeformableMap::RemovePoint(int slot) {
  CHECK(alive(slot)) << "slot " << slot;
  Detach(slot);
  points_.Remove(slot);
  free_slots_.push_back(slot);
  --num_points_;
}

void DeformableMap::Detach(int slot) {
  std::vector<int>& owner = points_of_node_[points_.binding(slot).nodes[0]];
  owner.erase(std::find(owner.begin(), owner.end(), slot));
}

Eigen::Vector3d DeformableMap::NodePosition(int node) const {
  return graph_.position(node) + NodeTranslation(state_.node(node));
}

// Eq. 1 without the camera: sum_j w_j [A_j (v - g_j) + g_j + t_j] = gradient v + offset.
LocalWarp DeformableMap::WarpOf(const Binding& binding) const {
  LocalWarp warp;
  warp.gradient.setZero();
  for (int i = 0; i < binding.size; ++i) {
    const int j = binding.nodes[i];
    const double w = binding.weights[i];
    const auto affine = NodeAffine(state_.node(j));
    warp.gradient += w * affine;
    warp.offset += w * (NodePosition(j) - affine * graph_.position(j));
  }
  return warp;
}

LocalWarp DeformableMap::RigidWarpOf(const Binding& binding) const {
  LocalWarp warp;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(WarpOf(binding).gradient,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const bool reflects = svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0;
  const Eigen::Vector3d signs(1.0, 1.0, reflects ? -1.0 : 1.0);
  warp.gradient = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  for (int i = 0; i < binding.size; ++i) {
    const int j = binding.nodes[i];
    warp.offset += binding.weights[i] * (NodePosition(j) - warp.gradient * graph_.position(j));
  }
  return warp;
}

std::vector<int> DeformableMap::NodesNearView(const ViewVolume& view) const {
  std::vector<int> nodes = index_.NearView(view, kReach);
  const auto outside = [&](int node) { return !view.MayTouch(NodePosition(node), kReach); };
  nodes.erase(std::remove_if(nodes.begin(), nodes.end(), outside), nodes.end());
  return nodes;
}

void DeformableMap::AddMemory(MapMemory* memory) const {
  memory->nodes += graph_.NodeHeapBytes() + state_.HeapBytes() + HeapBytesOf(node_prior_);
  memory->edges += graph_.EdgeHeapBytes();
  memory->node_index += index_.HeapBytes();
  memory->points += points_.PointHeapBytes();
  memory->bindings += points_.BindingHeapBytes();
  memory->point_lists += HeapBytesOfAll(points_of_node_) + HeapBytesOf(free_slots_);
}

}  // namespace ceres_ed
