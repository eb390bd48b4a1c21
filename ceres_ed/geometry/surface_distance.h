// Distances along a surface, by shortest paths over SurfaceTopology::paths.
#ifndef CERES_ED_GEOMETRY_SURFACE_DISTANCE_H_
#define CERES_ED_GEOMETRY_SURFACE_DISTANCE_H_

#include <ceres_ed/geometry/topology.h>

#include <cstddef>
#include <vector>

namespace ceres_ed {

// For every point its nearest seeds, in flat arrays of `k` places a point.
struct NearestSeeds {
  int k = 0;
  // Indices into the list of seeds by distance, then by index; -1 where there are fewer than k.
  std::vector<int> seeds;
  // In the unit of the points; infinite where `seeds` has -1.
  std::vector<double> distances;

  const int* SeedsOf(int point) const { return &seeds[static_cast<std::size_t>(point) * k]; }
  const double* DistancesOf(int point) const {
    return &distances[static_cast<std::size_t>(point) * k];
  }
  // How many seeds reach the point, at most k.
  int Count(int point) const;
};

// The k nearest seeds of every point along the surface. `seed_points` are point indices; the same
// position may be a seed more than once. `offsets` is empty, or one length >= 0 a seed that is
// added to every distance from it. The distance is symmetric up to rounding, and is exact on a
// plane along mesh edges and across two triangles; elsewhere it is too long, by 4 % at worst on
// equilateral triangles and by 8 % on a grid of right ones.
NearestSeeds NearestSeedsAlongSurface(const SurfaceTopology& topology,
                                      const std::vector<int>& seed_points,
                                      int k,
                                      const std::vector<double>& offsets = {});

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_SURFACE_DISTANCE_H_
