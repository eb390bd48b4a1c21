// What the solver moves: the parameters of every node and the camera.
#ifndef CERES_ED_GRAPH_DEFORMATION_STATE_H_
#define CERES_ED_GRAPH_DEFORMATION_STATE_H_

#include <cstddef>
#include <vector>

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

// Contiguous node blocks (layout: cost_functions/node_parameters.h) and the camera.
// Adding nodes may move the blocks: no Problem may be alive over them then.
class DeformationState {
 public:
  DeformationState() = default;
  // All nodes at rest.
  explicit DeformationState(int num_nodes) { Resize(num_nodes); }

  int num_nodes() const { return static_cast<int>(nodes_.size() / kNodeSize); }
  double* node(int index) { return &nodes_[static_cast<std::size_t>(index) * kNodeSize]; }
  const double* node(int index) const {
    return &nodes_[static_cast<std::size_t>(index) * kNodeSize];
  }

  // Keeps the nodes that are there; new ones are at rest.
  void Resize(int num_nodes) {
    const int old_size = this->num_nodes();
    nodes_.resize(static_cast<std::size_t>(num_nodes) * kNodeSize);
    for (int j = old_size; j < num_nodes; ++j) SetNodeToRest(node(j));
  }

  CameraPose camera_from_map;

 private:
  std::vector<double> nodes_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_DEFORMATION_STATE_H_
