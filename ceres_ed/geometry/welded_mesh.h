// The welded points of a cloud, numbered for a solve, and how they hang together.
#ifndef CERES_ED_GEOMETRY_WELDED_MESH_H_
#define CERES_ED_GEOMETRY_WELDED_MESH_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/topology.h>

#include <array>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace ceres_ed {

// One vertex for each position of a cloud's points; isolated ones too. Triangles that use a
// position twice are left out.
struct WeldedMesh {
  // The vertex of every point, and the point (the lowest) of every vertex.
  std::vector<int> vertex_of_point;
  std::vector<int> point_of_vertex;
  std::vector<std::array<int, 3>> triangles;
  // The triangles of vertex v: around[around_offsets[v]] to around[around_offsets[v + 1]].
  std::vector<int> around_offsets;
  std::vector<int> around;
  // Each edge once: of the mesh, or of bare points from each to its nearest ones.
  std::vector<std::pair<int, int>> edges;

  int num_vertices() const { return static_cast<int>(point_of_vertex.size()); }
};

// The vertices, triangles and edges of `cloud`, whose topology is `topology`.
WeldedMesh BuildWeldedMesh(const PointCloud& cloud, const SurfaceTopology& topology);

// The lower triangle of B = L D^-1 L, the square of the uniform Laplacian L = D - adjacency with D
// the number of edges: x' B x sums over the vertices, with their number of edges, the squared
// difference between a value and the mean of its neighbours.
Eigen::SparseMatrix<double> SquaredLaplacian(const WeldedMesh& mesh);

// Area-weighted unit normals of the triangles at `points` (one a vertex); zero without triangles.
std::vector<Eigen::Vector3d> WeldedNormals(const WeldedMesh& mesh,
                                           const std::vector<Eigen::Vector3d>& points);

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_WELDED_MESH_H_
