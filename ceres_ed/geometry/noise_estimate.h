// How noisy a measured surface is.
#ifndef CERES_ED_GEOMETRY_NOISE_ESTIMATE_H_
#define CERES_ED_GEOMETRY_NOISE_ESTIMATE_H_

#include <ceres_ed/geometry/topology.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// How noise is told from shape.
struct NoiseOptions {
  // Places where it is measured, spread over the cloud, >= 1.
  int samples = 500;
  // Neighbours that the smaller of two local fits takes, >= 8; the larger takes twice as many.
  int neighbors = 20;
  // Both are doubled, up to this often, while the noise isn't small against the larger fit's width.
  int max_doublings = 3;
};

// The standard deviation of the noise of `points` across their surface, in their unit; 0 for a
// smooth surface, and where there are too few points to tell.
//
// Around each sample a quadric (six coefficients over the plane of least spread) is fitted to its
// neighbours (along the edges; the nearest ones of bare points), and to twice as many. What is left
// over has the variance of the noise plus what a quadric can't follow, which grows with the cube of
// the number of points: the two sizes tell them apart. The median over the samples is that of a
// chi-square variable and is divided by it. Noise along one direction counts with its part across
// the surface. Points at the same position count once. `topology` is that of a cloud of `points`.
double EstimateNoise(const std::vector<Eigen::Vector3d>& points,
                     const SurfaceTopology& topology,
                     const NoiseOptions& options = {});

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_NOISE_ESTIMATE_H_
