// Warps for tests of maps of space.
#ifndef CERES_ED_TEST_GRAPH_WARP_EXAMPLES_H_
#define CERES_ED_TEST_GRAPH_WARP_EXAMPLES_H_

#include <ceres_ed/graph/warp.h>

#include <vector>

#include <Eigen/Geometry>
#include <cost_functions/node_parameters.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {

// Returns a warp of `size`^3 nodes on a cubic grid of the spacing 1. Node j turns by up to `turn`
// radians about an axis of its own and moves by up to `shift`.
inline Warp MakeLatticeWarp(int size, double turn, double shift) {
  Warp warp;
  for (int i = 0; i < size * size * size; ++i) {
    const int layer = i / (size * size);
    warp.graph.AddNode(Eigen::Vector3d(i % size, (i / size) % size, layer));
  }
  warp.state.Resize(warp.graph.num_nodes());
  const std::vector<Eigen::Vector3d> random = RandomPoints(2 * warp.graph.num_nodes(), 5);
  for (int j = 0; j < warp.graph.num_nodes(); ++j) {
    const Eigen::AngleAxisd rotation(turn * random[2 * j].norm(), random[2 * j].normalized());
    MutableNodeAffine(warp.state.node(j)) = rotation.toRotationMatrix();
    MutableNodeTranslation(warp.state.node(j)) = shift * random[2 * j + 1];
  }
  return warp;
}

// Returns a warp of `size`^3 nodes on a cubic grid of the spacing 1 that bends space smoothly: the
// nodes agree on the displacement amount * (sin y / 2, sin z / 2, sin x / 2) to first order.
inline Warp MakeBendingWarp(int size, double amount) {
  Warp warp = MakeLatticeWarp(size, 0.0, 0.0);
  for (int j = 0; j < warp.graph.num_nodes(); ++j) {
    const Eigen::Vector3d half = 0.5 * warp.graph.position(j);
    const Eigen::Vector3d sine = half.array().sin();
    const Eigen::Vector3d slope = 0.5 * half.array().cos();
    MutableNodeTranslation(warp.state.node(j)) =
        amount * Eigen::Vector3d(sine.y(), sine.z(), sine.x());
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Identity();
    for (int r = 0; r < 3; ++r) gradient(r, (r + 1) % 3) = amount * slope[(r + 1) % 3];
    MutableNodeAffine(warp.state.node(j)) = gradient;
  }
  return warp;
}

// Returns the warp with every node moved by `similarity`, which it is then as a whole.
inline Warp MakeSimilarityWarp(const Similarity& similarity) {
  Warp warp = MakeLatticeWarp(3, 0.0, 0.0);
  for (int j = 0; j < warp.graph.num_nodes(); ++j) {
    const Eigen::Vector3d& g = warp.graph.position(j);
    MutableNodeAffine(warp.state.node(j)) =
        similarity.scale * similarity.rotation.toRotationMatrix();
    MutableNodeTranslation(warp.state.node(j)) = similarity * g - g;
  }
  return warp;
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_GRAPH_WARP_EXAMPLES_H_
