// The deformation itself: Eq. 1 on points, normals and whole clouds.
#ifndef CERES_ED_GRAPH_WARP_H_
#define CERES_ED_GRAPH_WARP_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/graph_options.h>
#include <ceres_ed/graph/skinning.h>
#include <ceres_ed/graph/vertex_field.h>
#include <ceres_ed/util/status.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// What a fit found, complete enough to deform any other cloud:
//   v~ = s R (sum_j w_j(v) [A_j (v - g_j) + g_j + t_j] + f(v)) + T
// with s, R, T = target_from_source and f what `finish` adds (nothing where that is empty).
struct Warp {
  // In the frame and unit of the source.
  DeformationGraph graph;
  // As many nodes as the graph. camera_from_map is identity: a fit keeps its rigid part in
  // target_from_source, and the functions below that take a Warp do not look at it.
  DeformationState state;
  Similarity target_from_source;
  // How points find their nodes.
  BindingOptions binding;
  // In the frame and unit of the source, added to what the nodes do.
  VertexField finish;
};

// sum_j w_j [A_j (v - g_j) + g_j + t_j]: the sum of Eq. 1, in the map frame (no camera).
Eigen::Vector3d WarpPoint(const DeformationGraph& graph,
                          const DeformationState& state,
                          const Binding& binding,
                          const Eigen::Vector3d& point);

// sum_j w_j A_j: how the warp turns and stretches near a point, with the weights held.
Eigen::Matrix3d WarpGradient(const DeformationState& state, const Binding& binding);

// The unit normal of the warped surface, in the map frame: the cofactor matrix of G = WarpGradient
// times `normal`, which is det(G) G^-T n but lives with a singular G, and agrees with the winding
// of the warped triangles also under a reflection. Where it vanishes (G of rank 1): the rotation
// nearest to G times `normal`. A zero normal stays zero.
Eigen::Vector3d WarpNormal(const DeformationState& state,
                           const Binding& binding,
                           const Eigen::Vector3d& normal);

// Writes WarpPoint of every point to `warped`, which is resized and may be `points` itself.
void WarpPoints(const DeformationGraph& graph,
                const DeformationState& state,
                const Skinning& skinning,
                const std::vector<Eigen::Vector3d>& points,
                int num_threads,
                std::vector<Eigen::Vector3d>* warped);

// Writes WarpNormal of every normal to `warped`, which is resized and may be `normals` itself.
void WarpNormals(const DeformationState& state,
                 const Skinning& skinning,
                 const std::vector<Eigen::Vector3d>& normals,
                 int num_threads,
                 std::vector<Eigen::Vector3d>* warped);

// Binds `cloud` (in the source frame) to the warp's graph and takes its points and normals into the
// target frame. Triangles stay. Where the warp has a finish, normals of a mesh turn along with
// those of its triangles; those of bare points are as the nodes have them. Fails on a warp without
// nodes or whose parts do not fit together.
Status ApplyWarp(const Warp& warp, PointCloud* cloud, int num_threads = 1);

// The same with the binding of the cloud's points at hand.
Status ApplyWarp(const Warp& warp,
                 const Skinning& skinning,
                 PointCloud* cloud,
                 int num_threads = 1);

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_WARP_H_
