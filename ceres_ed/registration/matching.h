// Finds closest-point correspondences between a moving source and a target, in both directions.
#ifndef CERES_ED_REGISTRATION_MATCHING_H_
#define CERES_ED_REGISTRATION_MATCHING_H_

#include <ceres_ed/energy/energy.h>
#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/surface.h>
#include <ceres_ed/registration/fit_options.h>
#include <ceres_ed/registration/fit_types.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A moving source: sampled points of a surface at their present positions.
struct MovedSource {
  // The surface at rest.
  const Surface* rest = nullptr;
  // The samples, as indices into `rest`.
  const std::vector<int>* samples = nullptr;
  // The present point and normal of each sample.
  const std::vector<Eigen::Vector3d>* points = nullptr;
  const std::vector<Eigen::Vector3d>* normals = nullptr;
};

// The closest points of a matching. The next matching of the same samples starts its searches from
// them, which makes it faster and does not change the result.
struct MatchMemory {
  // For each source sample, its closest place on the target (SurfaceHit::place), or -1 if there is
  // none.
  std::vector<int> on_target;
  // For each target sample, its closest source sample, or -1 if there is none.
  std::vector<int> in_source;
  // The search tree of the source samples, and the vector to which it refers. The tree is built
  // again for another vector.
  std::unique_ptr<KdTree> source_tree;
  const std::vector<Eigen::Vector3d>* source_points = nullptr;
  // The target samples in an order in which neighbours are near each other.
  std::vector<int> target_order;
};

// Pairs each source sample with its closest point on the target, and each of `target_samples` with
// its closest source sample.
//
// The normal of a pair is the mean of the normals of both surfaces (symmetric point-to-plane), so
// that two points on one arc have no distance along it. A source sample represents a disc; a
// lateral offset within this disc does not count as distance. A pair is rejected because of its
// distance, because of the angle between the normals, or because the closest point lies on the
// border of its surface, where the other surface continues beyond it. Weights are relative areas;
// the weights of each direction sum to at most 1. `memory` may be null.
Matches MatchBothWays(const MovedSource& source,
                      const Surface& target,
                      const std::vector<int>& target_samples,
                      const MatchingOptions& options,
                      MatchMemory* memory = nullptr);

// The unmatched share of each surface, in [0, 1].
struct Unmatched {
  double source = 1.0;
  double target = 1.0;

  double Mean() const { return 0.5 * (source + target); }
  // Returns a mean in which the surface that is explained better has most of the weight. What a
  // partial target does not show cannot be explained, and is no evidence for or against a warp.
  double Total() const { return 0.8 * std::min(source, target) + 0.2 * std::max(source, target); }
};

// Returns the mean over the samples of each surface of d^2 / (d^2 + width^2), which is 1 for a
// sample without a closest point or with disagreeing normals. Without samples the result is 1.
Unmatched FindUnmatched(const MovedSource& source,
                        const Surface& target,
                        const std::vector<int>& target_samples,
                        double width,
                        const MatchingOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_MATCHING_H_
