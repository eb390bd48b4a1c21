// An estimate of the noise of a measured surface.
#ifndef CERES_ED_GEOMETRY_NOISE_ESTIMATE_H_
#define CERES_ED_GEOMETRY_NOISE_ESTIMATE_H_

#include <ceres_ed/geometry/topology.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Options of EstimateNoise().
struct NoiseOptions {
  // The number of points, spread over the cloud, at which the noise is measured. At least 1.
  int samples = 500;
  // The number of neighbours in the smaller of two local fits, at least 8. The larger fit has twice
  // as many.
  int neighbors = 20;
  // How often both numbers may be doubled, at least 0. They are doubled while the noise is not
  // small compared with the width of the larger fit.
  int max_doublings = 3;
};

// Returns the standard deviation of the noise of `points` across their surface, in their unit. It
// is 0 for a smooth surface, and if there are too few points. `topology` is the topology of a cloud
// of `points`.
//
// A quadric (six coefficients over the plane of least spread) is fitted to the neighbours of each
// sample, and another one to twice as many neighbours. Neighbours are found along the edges of a
// mesh, or in space without a mesh. The residual of such a fit has the variance of the noise, plus
// the part of the shape that a quadric can't represent. That part grows with the cube of the number
// of points, so the two sizes tell noise and shape apart. The median over the samples is divided by
// the median of a chi-square variable. Noise along one direction counts with its component across
// the surface. Points at the same position count once.
double EstimateNoise(const std::vector<Eigen::Vector3d>& points,
                     const SurfaceTopology& topology,
                     const NoiseOptions& options = {});

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_NOISE_ESTIMATE_H_
