// Computes closed triangle meshes of well-shaped triangles for implicit bodies.
#ifndef CERES_ED_SIMULATION_MESHING_H_
#define CERES_ED_SIMULATION_MESHING_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/simulation/solid.h>

namespace ceres_ed {

// Returns the surface of `solid` as a closed, manifold, outward oriented mesh, computed by marching
// tetrahedra on a grid with the given cell size (> 0, in the unit of the solid). The triangles may
// have any shape, and parts of the body that are thinner than a cell are lost.
PointCloud MarchTetrahedra(const SyntheticSolid& solid, double cell);

// Returns `mesh` (closed and manifold) remeshed to near-equilateral triangles with about `vertices`
// (>= 100) vertices, all of which lie on the surface of `solid`. The topology does not change.
PointCloud RemeshUniformly(const PointCloud& mesh, const SyntheticSolid& solid, int vertices);

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_MESHING_H_
