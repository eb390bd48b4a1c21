// Well-spread subsets of the points of a surface.
#ifndef CERES_ED_GEOMETRY_SAMPLING_H_
#define CERES_ED_GEOMETRY_SAMPLING_H_

#include <ceres_ed/geometry/topology.h>

#include <limits>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// All functions return point indices in the order in which they were chosen, the same at every run
// and for every order of the input points (up to ties). "Within" is up to a relative 1e-9, so that
// rounding does not decide about points that are a spacing apart.

// When farthest-point sampling ends: whichever comes first.
struct FarthestPointOptions {
  // No more samples than this; at least 1.
  int max_count = std::numeric_limits<int>::max();
  // No sample nearer than this to another one; >= 0, in the unit of the points.
  double min_spacing = 0.0;
};

// A greedy cover: walks the points by x, y, z and takes each that has no taken one within `spacing`
// > 0. Samples are at least `spacing` apart, and every point has one within `spacing`.
std::vector<int> UniformDownsample(const std::vector<Eigen::Vector3d>& points, double spacing);

// The same with distances along the surface, so that two surfaces that touch get samples of their
// own. Components of fewer than `min_component_points` positions get none (they stay uncovered),
// all others at least one.
std::vector<int> UniformDownsampleAlongSurface(const SurfaceTopology& topology,
                                               double spacing,
                                               int min_component_points = 1);

// Starts at the point of lowest x, y, z and takes the point farthest from all that are taken, until
// max_count are there, or the next one is nearer than min_spacing, or all positions are taken.
std::vector<int> FarthestPointSample(const std::vector<Eigen::Vector3d>& points,
                                     const FarthestPointOptions& options);

// The same with distances along the surface. Components of fewer than `min_component_points`
// positions get none; all others get their first sample before any gets its second.
std::vector<int> FarthestPointSampleAlongSurface(const SurfaceTopology& topology,
                                                 const FarthestPointOptions& options,
                                                 int min_component_points = 1);

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_SAMPLING_H_
