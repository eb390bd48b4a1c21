// Well-shaped closed triangle meshes of implicit bodies.
#ifndef CERES_ED_SIMULATION_MESHING_H_
#define CERES_ED_SIMULATION_MESHING_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/simulation/solid.h>

namespace ceres_ed {

// Returns the surface of `solid` as a closed, manifold, outward oriented mesh by marching
// tetrahedra on a grid of the given cell size (> 0, unit of the solid). Triangles are of any shape;
// parts thinner than a cell are lost.
PointCloud MarchTetrahedra(const SyntheticSolid& solid, double cell);

// Returns `mesh` (closed and manifold) remeshed to about `vertices` (>= 100) near-equilateral
// triangles with every vertex on the surface of `solid`; the topology stays as it is.
PointCloud RemeshUniformly(const PointCloud& mesh, const SyntheticSolid& solid, int vertices);

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_MESHING_H_
