// The parameters that the solver changes: those of every node and of the camera.
#ifndef CERES_ED_GRAPH_DEFORMATION_STATE_H_
#define CERES_ED_GRAPH_DEFORMATION_STATE_H_

#include <ceres_ed/geometry/rigid_transform.h>
#include <ceres_ed/util/chunked_rows.h>

#include <cstddef>

#include <Eigen/Core>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {

// The camera pose camera_from_map: R_c and T_c of Eq. 1, in map units.
using CameraPose = RigidTransform;

// The parameter blocks of all nodes (see cost_functions/node_parameters.h for their layout) and the
// camera. Adding nodes does not move the existing blocks, so pointers to them stay valid.
class DeformationState {
 public:
  DeformationState() = default;
  // All nodes are at rest.
  explicit DeformationState(int num_nodes) { Resize(num_nodes); }

  int num_nodes() const { return static_cast<int>(nodes_.size()); }
  // The parameter block of a node (12 doubles).
  double* node(int index) { return nodes_[static_cast<std::size_t>(index)]; }
  const double* node(int index) const { return nodes_[static_cast<std::size_t>(index)]; }

  // Changes the number of nodes. Existing nodes keep their parameters; new ones are at rest.
  void Resize(int num_nodes) {
    const int old_size = this->num_nodes();
    nodes_.Resize(static_cast<std::size_t>(num_nodes));
    for (int j = old_size; j < num_nodes; ++j) SetNodeToRest(node(j));
  }

  // The memory of the nodes on the heap, in bytes.
  std::size_t HeapBytes() const { return nodes_.HeapBytes(); }

  CameraPose camera_from_map;

 private:
  ChunkedRows<double> nodes_{kNodeSize};
};

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_DEFORMATION_STATE_H_
