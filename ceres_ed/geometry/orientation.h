// Which side of a surface is its outside: consistency of windings and of the signs of normals.
#ifndef CERES_ED_GEOMETRY_ORIENTATION_H_
#define CERES_ED_GEOMETRY_ORIENTATION_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/topology.h>

#include <vector>

namespace ceres_ed {

// Returns the triangles that are wound against their neighbours, lowest index first. In each part
// that is connected by edges of exactly two triangles, these are the ones whose area is the smaller
// share; after they have been reversed, the part is consistent. (A part that has only one side,
// like a Moebius strip, keeps one line along which triangles disagree.) `topology` must be that of
// `cloud`.
std::vector<int> TrianglesAgainstNeighbors(const PointCloud& cloud,
                                           const SurfaceTopology& topology);

// Returns the part of the points, of those with a normal on both sides, whose normal in `cloud`
// points to the inner side of the triangles around it; in [0, 1], 0 without triangles or normals.
double ShareOfNormalsAgainstTriangles(const PointCloud& cloud);

// Returns the part of the neighbouring points, of those that lie in the tangent planes of each
// other, whose normals point to opposite sides; in [0, 1]. At most some thousand points are looked
// at. It is near 0 where the signs are consistent, and 0.5 where they are random.
double ShareOfContradictingNormals(const PointCloud& cloud);

// Returns the volume that a closed mesh encloses, in cubed units of its points: positive if it is
// wound counter-clockwise as seen from outside. Returns 0 if the mesh is not closed (more than 2 %
// of its edges are borders), or if the volume is too small to tell the sides apart.
double EnclosedVolume(const PointCloud& cloud, const SurfaceTopology& topology);

// Turns the surface inside out: reverses all triangles and normals.
void ReverseOrientation(PointCloud* cloud);

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_ORIENTATION_H_
