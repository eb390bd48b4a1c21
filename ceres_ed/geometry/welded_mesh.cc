#include "ceres_ed/geometry/welded_mesh.h"

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/triangle_area.h>

#include <algorithm>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

// The number of neighbours of a point without triangles. A vertex of a regular mesh has as many.
constexpr int kBareNeighbors = 6;

void NumberVertices(const SurfaceTopology& topology, WeldedMesh* mesh) {
  const int num_points = topology.num_points();
  mesh->vertex_of_point.resize(num_points);
  for (int p = 0; p < num_points; ++p) {
    if (topology.representative[p] == p) {
      mesh->vertex_of_point[p] = mesh->num_vertices();
      mesh->point_of_vertex.push_back(p);
    } else {
      mesh->vertex_of_point[p] = mesh->vertex_of_point[topology.representative[p]];
    }
  }
}

void CollectTriangles(const PointCloud& cloud, WeldedMesh* mesh) {
  mesh->around_offsets.assign(mesh->num_vertices() + 1, 0);
  for (const std::array<int, 3>& t : cloud.triangles) {
    const std::array<int, 3> corners = {
        mesh->vertex_of_point[t[0]], mesh->vertex_of_point[t[1]], mesh->vertex_of_point[t[2]]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    mesh->triangles.push_back(corners);
    for (const int corner : corners) ++mesh->around_offsets[corner + 1];
  }
  for (int v = 0; v < mesh->num_vertices(); ++v) {
    mesh->around_offsets[v + 1] += mesh->around_offsets[v];
  }
  mesh->around.resize(mesh->around_offsets.back());
  std::vector<int> next(mesh->around_offsets.begin(), mesh->around_offsets.end() - 1);
  for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
    for (const int corner : mesh->triangles[t]) mesh->around[next[corner]++] = static_cast<int>(t);
  }
}

void CollectEdges(const PointCloud& cloud, const SurfaceTopology& topology, WeldedMesh* mesh) {
  if (cloud.HasTriangles()) {
    for (int v = 0; v < mesh->num_vertices(); ++v) {
      for (const SurfaceLink& link : topology.Edges(mesh->point_of_vertex[v])) {
        const int to = mesh->vertex_of_point[link.to];
        if (to > v) mesh->edges.emplace_back(v, to);
      }
    }
    return;
  }
  std::vector<Eigen::Vector3d> points;
  for (const int point : mesh->point_of_vertex) points.push_back(cloud.points[point]);
  const KdTree tree(points);
  std::vector<Neighbor> neighbors;
  for (int v = 0; v < mesh->num_vertices(); ++v) {
    tree.KNearest(points[v], kBareNeighbors + 1, &neighbors);
    for (const Neighbor& neighbor : neighbors) {
      if (neighbor.index != v) mesh->edges.push_back(std::minmax(v, neighbor.index));
    }
  }
  std::sort(mesh->edges.begin(), mesh->edges.end());
  mesh->edges.erase(std::unique(mesh->edges.begin(), mesh->edges.end()), mesh->edges.end());
}

}  // namespace

WeldedMesh BuildWeldedMesh(const PointCloud& cloud, const SurfaceTopology& topology) {
  WeldedMesh mesh;
  NumberVertices(topology, &mesh);
  CollectTriangles(cloud, &mesh);
  CollectEdges(cloud, topology, &mesh);
  return mesh;
}

Eigen::SparseMatrix<double> SquaredLaplacian(const WeldedMesh& mesh) {
  const int size = mesh.num_vertices();
  // The neighbours of each vertex, in ascending order.
  std::vector<int> offsets(size + 1, 0);
  for (const auto& [a, b] : mesh.edges) {
    ++offsets[a + 1];
    ++offsets[b + 1];
  }
  for (int v = 0; v < size; ++v) offsets[v + 1] += offsets[v];
  std::vector<int> neighbors(offsets.back());
  std::vector<int> next(offsets.begin(), offsets.end() - 1);
  for (const auto& [a, b] : mesh.edges) {
    neighbors[next[a]++] = b;
    neighbors[next[b]++] = a;
  }
  const auto degree = [&](int v) { return offsets[v + 1] - offsets[v]; };

  Eigen::SparseMatrix<double> matrix(size, size);
  std::vector<double> column(size, 0.0);
  std::vector<int> rows;
  std::vector<char> is_set(size, 0);
  const auto add = [&](int row, int lowest, double value) {
    if (row < lowest) return;
    if (is_set[row] == 0) rows.push_back(row);
    is_set[row] = 1;
    column[row] += value;
  };
  matrix.reserve(static_cast<long>(size) * 11);
  for (int v = 0; v < size; ++v) {
    // Add up column v of L D^-1 L, where L_uu = D_u.
    add(v, v, degree(v));
    for (int e = offsets[v]; e < offsets[v + 1]; ++e) {
      const int u = neighbors[e];
      add(u, v, -2.0);
      for (int f = offsets[u]; f < offsets[u + 1]; ++f) add(neighbors[f], v, 1.0 / degree(u));
    }
    std::sort(rows.begin(), rows.end());
    matrix.startVec(v);
    for (const int row : rows) {
      matrix.insertBack(row, v) = column[row];
      column[row] = 0.0;
      is_set[row] = 0;
    }
    rows.clear();
  }
  matrix.finalize();
  return matrix;
}

std::vector<Eigen::Vector3d> WeldedNormals(const WeldedMesh& mesh,
                                           const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector3d> normals(points.size(), Eigen::Vector3d::Zero());
  for (const std::array<int, 3>& t : mesh.triangles) {
    const Eigen::Vector3d area = AreaVector(points, t);
    for (const int corner : t) normals[corner] += area;
  }
  for (Eigen::Vector3d& normal : normals) {
    const double norm = normal.norm();
    if (norm > 0.0) normal /= norm;
  }
  return normals;
}

}  // namespace ceres_ed
