// Distances along a surface: the lengths of shortest paths over SurfaceTopology::paths.
#ifndef CERES_ED_GEOMETRY_SURFACE_DISTANCE_H_
#define CERES_ED_GEOMETRY_SURFACE_DISTANCE_H_

#include <ceres_ed/geometry/topology.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace ceres_ed {

// The nearest seeds of every point, in flat arrays with `k` entries for each point.
struct NearestSeeds {
  int k = 0;
  // Indices into the list of seeds, sorted by distance, then by index; -1 if fewer than k seeds
  // reach the point.
  std::vector<int> seeds;
  // The distances, in the unit of the points; infinite where `seeds` is -1.
  std::vector<double> distances;

  // Return the k entries of a point in `seeds` and in `distances`.
  const int* SeedsOf(int point) const { return &seeds[static_cast<std::size_t>(point) * k]; }
  const double* DistancesOf(int point) const {
    return &distances[static_cast<std::size_t>(point) * k];
  }
  // Returns how many seeds reach the point, at most k.
  int Count(int point) const;
};

// Returns the k nearest seeds of every point along the surface. `seed_points` are indices of
// points; the same position may be a seed more than once. `offsets` is empty, or has one length >=
// 0 for each seed, which is added to every distance from it. The distance is symmetric up to
// rounding. It is exact on a plane along mesh edges and across two triangles. In all other cases it
// is too long, by at most 4 % on equilateral triangles and 8 % on a grid of right triangles. If
// `should_stop` returns true, the search ends, and more points are unreached.
NearestSeeds NearestSeedsAlongSurface(const SurfaceTopology& topology,
                                      const std::vector<int>& seed_points,
                                      int k,
                                      const std::vector<double>& offsets = {},
                                      const std::function<bool()>& should_stop = {});

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_SURFACE_DISTANCE_H_
