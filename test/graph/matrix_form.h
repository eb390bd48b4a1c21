// The paper's matrix form of the warp (Eq. 8-13), with which the per-vertex form is compared.
#ifndef CERES_ED_TEST_GRAPH_MATRIX_FORM_H_
#define CERES_ED_TEST_GRAPH_MATRIX_FORM_H_

#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/skinning.h>

#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace ceres_ed {

// Returns Pi = [M C], with one row for each vertex: M has w_j (v - g_j)^T in the three columns of
// node j, and C has w_j in column j. It depends only on the rest shape.
inline Eigen::SparseMatrix<double> MatrixPi(const DeformationGraph& graph,
                                            const Skinning& skinning,
                                            const std::vector<Eigen::Vector3d>& points) {
  const int n = graph.num_nodes();
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Binding binding = skinning[p];
    for (int i = 0; i < binding.size; ++i) {
      const int j = binding.nodes[i];
      const Eigen::Vector3d local = points[p] - graph.position(j);
      for (int axis = 0; axis < 3; ++axis) {
        entries.emplace_back(p, 3 * j + axis, binding.weights[i] * local[axis]);
      }
      entries.emplace_back(p, 3 * n + j, binding.weights[i]);
    }
  }
  Eigen::SparseMatrix<double> Pi(static_cast<Eigen::Index>(points.size()), 4 * n);
  Pi.setFromTriplets(entries.begin(), entries.end());
  return Pi;
}

// Returns Phi = [Lambda; T]: Lambda has the A_j^T on top of one another, and T has the (g_j +
// t_j)^T.
inline Eigen::MatrixXd MatrixPhi(const DeformationGraph& graph, const DeformationState& state) {
  const int n = graph.num_nodes();
  Eigen::MatrixXd Phi(4 * n, 3);
  for (int j = 0; j < n; ++j) {
    const double* node = state.node(j);
    for (int column = 0; column < 3; ++column) {
      for (int row = 0; row < 3; ++row) Phi(3 * j + column, row) = node[3 * column + row];
    }
    for (int axis = 0; axis < 3; ++axis) {
      Phi(3 * n + j, axis) = graph.position(j)[axis] + node[9 + axis];
    }
  }
  return Phi;
}

// Returns R_c [Pi Phi]^T + T_c (x) 1, with one column for each vertex, in the camera frame.
inline Eigen::MatrixXd WarpByMatrices(const DeformationGraph& graph,
                                      const DeformationState& state,
                                      const Skinning& skinning,
                                      const std::vector<Eigen::Vector3d>& points) {
  const Eigen::MatrixXd in_map = MatrixPi(graph, skinning, points) * MatrixPhi(graph, state);
  return (state.camera_from_map.rotation.toRotationMatrix() * in_map.transpose()).colwise() +
         state.camera_from_map.translation;
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_GRAPH_MATRIX_FORM_H_
