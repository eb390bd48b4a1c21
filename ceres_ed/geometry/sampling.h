// Well-spread subsets of the points of a surface.
#ifndef CERES_ED_GEOMETRY_SAMPLING_H_
#define CERES_ED_GEOMETRY_SAMPLING_H_

#include <ceres_ed/geometry/topology.h>

#include <limits>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// All functions return indices of points in the order in which they were chosen. The result is the
// same at every run, and the same points are chosen for every order of the input points (up to
// ties). "Within" allows a relative tolerance of 1e-9, so that rounding does not decide about
// points that are exactly one spacing apart.

// When farthest-point sampling ends. It ends at the limit that is reached first.
struct FarthestPointOptions {
  // The largest number of samples, at least 1.
  int max_count = std::numeric_limits<int>::max();
  // The smallest distance between two samples, >= 0, in the unit of the points.
  double min_spacing = 0.0;
};

// Returns a greedy cover. The points are visited by x, y, z, and a point is chosen if no chosen
// point lies within `spacing` > 0 of it. So chosen points are at least `spacing` apart, and every
// point has a chosen one within `spacing`.
std::vector<int> UniformDownsample(const std::vector<Eigen::Vector3d>& points, double spacing);

// Does the same with distances along the surface, so that two surfaces that touch get separate
// samples. Components of fewer than `min_component_points` positions get no samples and stay
// uncovered; all others get at least one.
std::vector<int> UniformDownsampleAlongSurface(const SurfaceTopology& topology,
                                               double spacing,
                                               int min_component_points = 1);

// Returns a farthest-point sampling. It starts at the point of lowest x, y, z, and always adds the
// point that is farthest from all chosen ones. It ends when max_count points are chosen, when the
// next one would be nearer than min_spacing, or when all positions are chosen.
std::vector<int> FarthestPointSample(const std::vector<Eigen::Vector3d>& points,
                                     const FarthestPointOptions& options);

// Does the same with distances along the surface. Components of fewer than `min_component_points`
// positions get no samples. All others get their first sample before any gets its second.
std::vector<int> FarthestPointSampleAlongSurface(const SurfaceTopology& topology,
                                                 const FarthestPointOptions& options,
                                                 int min_component_points = 1);

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_SAMPLING_H_
