// The deformation of Eq. 1, applied to points, normals and whole clouds.
#ifndef CERES_ED_GRAPH_WARP_H_
#define CERES_ED_GRAPH_WARP_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/graph_options.h>
#include <ceres_ed/graph/skinning.h>
#include <ceres_ed/util/status.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// One displacement for each point, both in the same frame and unit. Points at the same position
// have the same displacement.
struct VertexField {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> displacements;

  bool empty() const { return points.empty(); }
};

// The result of a fit. It is complete, so it can deform any other cloud:
//   v~ = s R (sum_j w_j(v) [A_j (v - g_j) + g_j + t_j] + f(v)) + T
// where s, R, T are target_from_source, and f is the displacement that `finish` adds (zero if it is
// empty).
struct Warp {
  // The graph, in the frame and unit of the source.
  DeformationGraph graph;
  // The parameters of the nodes, as many as the graph has. camera_from_map is the identity: the
  // rigid part of a fit is in target_from_source, and the functions below that take a Warp do not
  // use the camera.
  DeformationState state;
  // The rigid placement and scale of the source in the target's frame.
  Similarity target_from_source;
  // The options for binding points to nodes.
  BindingOptions binding;
  // Displacements, in the frame and unit of the source, that are added to the motion of the nodes.
  VertexField finish;
  // Whether the source was mended before the fit (RepairCloud of preflight/repair.h). Meshes whose
  // points are bound to the graph must be mended, too; ApplyWarp() does not do it.
  bool repaired = false;
};

// Returns the warped point in the map frame, without the camera: sum_j w_j [A_j (v - g_j) + g_j +
// t_j] (the sum in Eq. 1).
Eigen::Vector3d WarpPoint(const DeformationGraph& graph,
                          const DeformationState& state,
                          const Binding& binding,
                          const Eigen::Vector3d& point);

// Returns sum_j w_j A_j, the gradient of the warp at a point when the weights are taken as
// constant. It says how the warp turns and stretches the surface there.
Eigen::Matrix3d WarpGradient(const DeformationState& state, const Binding& binding);

// Returns the unit normal of the warped surface, in the map frame. It is the cofactor matrix of G =
// WarpGradient() times `normal`, normalised. This is det(G) G^-T n, but it also exists for a
// singular G, and it agrees with the orientation of the warped triangles under a reflection, too.
// If it vanishes (G of rank 1), the rotation nearest to G is applied to `normal`. A zero normal
// stays zero.
Eigen::Vector3d WarpNormal(const DeformationState& state,
                           const Binding& binding,
                           const Eigen::Vector3d& normal);

// Writes the WarpPoint() of every point to `warped`, which is resized and may be `points` itself.
void WarpPoints(const DeformationGraph& graph,
                const DeformationState& state,
                const Skinning& skinning,
                const std::vector<Eigen::Vector3d>& points,
                int num_threads,
                std::vector<Eigen::Vector3d>* warped);

// Writes the WarpNormal() of every normal to `warped`, which is resized and may be `normals`
// itself.
void WarpNormals(const DeformationState& state,
                 const Skinning& skinning,
                 const std::vector<Eigen::Vector3d>& normals,
                 int num_threads,
                 std::vector<Eigen::Vector3d>* warped);

// Binds `cloud` (in the source frame) to the warp's graph and moves its points and normals into the
// target frame. Triangles are not changed. If the warp has a finish, the normals of a mesh turn
// together with those of its triangles; normals of a cloud without triangles follow the nodes only.
// Returns an error for a warp without nodes or with parts of different sizes.
Status ApplyWarp(const Warp& warp, PointCloud* cloud, int num_threads = 1);

// Does the same if the binding of the cloud's points is available already.
Status ApplyWarp(const Warp& warp,
                 const Skinning& skinning,
                 PointCloud* cloud,
                 int num_threads = 1);

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_WARP_H_
