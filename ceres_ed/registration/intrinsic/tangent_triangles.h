// Triangles between bare points, from the tangent plane of each.
#ifndef CERES_ED_REGISTRATION_INTRINSIC_TANGENT_TRIANGLES_H_
#define CERES_ED_REGISTRATION_INTRINSIC_TANGENT_TRIANGLES_H_

#include <array>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns the triangles of the local Delaunay triangulations (as in Sharp and Crane 2020, "A
// Laplacian for nonmanifold triangle meshes", Section 5.7): around each point its neighbours are
// projected onto the tangent plane, and the triangles that the planar Delaunay triangulation has at
// this point are taken. So most triangles occur three times, once for each corner. `points` are
// about `spacing` > 0 apart; neighbours are searched within twice this distance. `normals` are of
// unit length, one for each point. If they are `oriented`, neighbours whose normals point away from
// that of the point belong to another sheet of the surface, and the corners of a triangle are
// counter-clockwise as seen from outside.
std::vector<std::array<int, 3>> TangentTriangles(const std::vector<Eigen::Vector3d>& points,
                                                 const std::vector<Eigen::Vector3d>& normals,
                                                 bool oriented,
                                                 double spacing);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_INTRINSIC_TANGENT_TRIANGLES_H_
