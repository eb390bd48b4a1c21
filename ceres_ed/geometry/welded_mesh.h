// The welded points of a cloud, numbered for a linear system, and how they are connected.
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

// A mesh with one vertex for each position of a cloud's points, isolated ones included. Triangles
// that use a position twice are left out.
struct WeldedMesh {
  // The vertex of each point, and the point (of lowest index) of each vertex.
  std::vector<int> vertex_of_point;
  std::vector<int> point_of_vertex;
  std::vector<std::array<int, 3>> triangles;
  // The triangles of vertex v are around[around_offsets[v]] to around[around_offsets[v + 1]].
  std::vector<int> around_offsets;
  std::vector<int> around;
  // The edges, each listed once. Without triangles they lead from each point to its nearest
  // neighbours.
  std::vector<std::pair<int, int>> edges;

  int num_vertices() const { return static_cast<int>(point_of_vertex.size()); }
};

// Returns the vertices, triangles and edges of `cloud`, whose topology is `topology`.
WeldedMesh BuildWeldedMesh(const PointCloud& cloud, const SurfaceTopology& topology);

// Returns the lower triangle of B = L D^-1 L, where L = D - adjacency is the uniform Laplacian and
// D is the number of edges of each vertex. x' B x is the sum over all vertices of the squared
// difference between the value at a vertex and the mean of its neighbours, weighted by its number
// of edges.
Eigen::SparseMatrix<double> SquaredLaplacian(const WeldedMesh& mesh);

// Returns the area-weighted unit normals of the vertices, given their positions `points`. They are
// zero at vertices without triangles.
std::vector<Eigen::Vector3d> WeldedNormals(const WeldedMesh& mesh,
                                           const std::vector<Eigen::Vector3d>& points);

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_WELDED_MESH_H_
