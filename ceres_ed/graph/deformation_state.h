// What the solver moves: the parameters of every node and the camera.
#ifndef CERES_ED_GRAPH_DEFORMATION_STATE_H_
#define CERES_ED_GRAPH_DEFORMATION_STATE_H_

#include <ceres_ed/util/chunked_rows.h>

#include <cstddef>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {

// camera_from_map: point_in_camera = rotation * point_in_map + translation (R_c, T_c of Eq. 1).
struct CameraPose {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  // Map units.
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& point_in_map) const {
    return rotation * point_in_map + translation;
  }
};

// Node blocks (layout: cost_functions/node_parameters.h) and the camera. Adding nodes moves no
// block that is there.
class DeformationState {
 public:
  DeformationState() = default;
  // All nodes at rest.
  explicit DeformationState(int num_nodes) { Resize(num_nodes); }

  int num_nodes() const { return static_cast<int>(nodes_.size()); }
  double* node(int index) { return nodes_[static_cast<std::size_t>(index)]; }
  const double* node(int index) const { return nodes_[static_cast<std::size_t>(index)]; }

  // Keeps the nodes that are there; new ones are at rest.
  void Resize(int num_nodes) {
    const int old_size = this->num_nodes();
    nodes_.Resize(static_cast<std::size_t>(num_nodes));
    for (int j = old_size; j < num_nodes; ++j) SetNodeToRest(node(j));
  }

  std::size_t HeapBytes() const { return nodes_.HeapBytes(); }

  CameraPose camera_from_map;

 private:
  ChunkedRows<double> nodes_{kNodeSize};
};

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_DEFORMATION_STATE_H_
