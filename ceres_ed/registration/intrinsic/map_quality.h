// How good a map between two surfaces is.
#ifndef CERES_ED_REGISTRATION_INTRINSIC_MAP_QUALITY_H_
#define CERES_ED_REGISTRATION_INTRINSIC_MAP_QUALITY_H_

#include <ceres_ed/registration/intrinsic/coarse_mesh.h>
#include <ceres_ed/registration/intrinsic/functional_map.h>

#include <vector>

namespace ceres_ed {

// Measures of a map between all vertices of two coarse meshes.
struct MapQuality {
  // The share of the triangles that the map does not collapse and that keep their side: near 1 for
  // a map of the surface as it is, near 0 for one that swaps left and right, 0.5 for scattered
  // images. It means nothing if the outer side of a surface is unknown.
  double orientation = 0.5;
  // The share of the vertices that come back to their neighbourhood when they are mapped to the
  // target and back. A part that has no place on the other surface does not come back.
  double returning = 0.0;
};

// Returns for each source vertex the distance in space, in spacings of `source`, from itself to
// where the map takes it and brings it back.
std::vector<double> ReturnDistances(const CoarseMesh& source, const PointMap& map);

// Returns the quality of a map of all vertices of both.
MapQuality MeasureMap(const CoarseMesh& source, const CoarseMesh& target, const PointMap& map);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_INTRINSIC_MAP_QUALITY_H_
