// A coarse triangulation of a surface on which spectra are computed.
#ifndef CERES_ED_REGISTRATION_INTRINSIC_COARSE_MESH_H_
#define CERES_ED_REGISTRATION_INTRINSIC_COARSE_MESH_H_

#include <ceres_ed/geometry/surface.h>

#include <array>
#include <functional>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A connected coarse mesh whose vertices are points of a surface.
struct CoarseMesh {
  // The index of each vertex among the points of the surface, and its position.
  std::vector<int> points;
  std::vector<Eigen::Vector3d> positions;
  // Triangles, counter-clockwise as seen from outside if `oriented`. Each counts with the weight
  // `triangle_weight`, because those of bare points occur up to three times.
  std::vector<std::array<int, 3>> triangles;
  double triangle_weight = 1.0;
  bool oriented = true;
  // The sum of the weighted areas of the triangles, and the mean distance of neighbours.
  double area = 0.0;
  double spacing = 0.0;
  // The share of the vertices that lie on a border of the surface.
  double border_share = 0.0;

  int size() const { return static_cast<int>(points.size()); }
};

// Returns the connected parts of `surface` that have at least a twentieth of its area, the largest
// first, thinned out to about `vertices` points in all. On a mesh, the vertices are spread along
// the surface, and three of them make a triangle where their cells (the points that are nearest to
// each along the surface) meet. So limbs that touch stay apart, and it does not matter how fine,
// how regular or how manifold the mesh is. Bare points are connected by TangentTriangles(). The
// result may be empty.
std::vector<CoarseMesh> BuildCoarseMeshes(const Surface& surface,
                                          int vertices,
                                          const std::function<bool()>& should_stop = {});

// Returns the unit normals of the vertices from the triangles around them; zero where the areas
// cancel.
std::vector<Eigen::Vector3d> CoarseNormals(const CoarseMesh& mesh);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_INTRINSIC_COARSE_MESH_H_
