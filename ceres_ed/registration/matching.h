// Closest-point correspondences between a moving source and a target, both ways.
#ifndef CERES_ED_REGISTRATION_MATCHING_H_
#define CERES_ED_REGISTRATION_MATCHING_H_

#include <ceres_ed/energy/energy.h>
#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/surface.h>
#include <ceres_ed/registration/fit_options.h>
#include <ceres_ed/registration/matches.h>

#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A moving source: some points of a surface as they are now.
struct MovedSource {
  const Surface* rest = nullptr;
  // Indices into `rest`.
  const std::vector<int>* samples = nullptr;
  // One a sample.
  const std::vector<Eigen::Vector3d>* points = nullptr;
  const std::vector<Eigen::Vector3d>* normals = nullptr;
};

// Where a matching found its closest points. The next one of the same samples starts from there,
// which makes it faster and changes nothing.
struct MatchMemory {
  // Of the samples of the source, on the target (SurfaceHit::place); -1 where there is none.
  std::vector<int> on_target;
  // Of the samples of the target, among the samples of the source; -1 where there is none.
  std::vector<int> in_source;
  // Of the samples of the source, and the vector that it refers to: another one gets another tree.
  std::unique_ptr<KdTree> source_tree;
  const std::vector<Eigen::Vector3d>* source_points = nullptr;
  // The samples of the target, such that neighbours are near each other.
  std::vector<int> target_order;
};

// Pairs each sample of the source with its closest point on the target, and each of
// `target_samples` with the sample of the source that is closest to it. Normals of pairs are the
// mean of both surfaces' (symmetric point-to-plane), so that points on one arc are at no distance
// along it; what lies aside within the disc that a sample stands for doesn't count as distance. A
// pair is rejected by distance, by the angle between the normals, and where the closest point lies
// on the border of its surface (the other side goes on where this one ends). Weights are relative
// areas; those of each direction sum to at most 1. `memory` may be null.
Matches MatchBothWays(const MovedSource& source,
                      const Surface& target,
                      const std::vector<int>& target_samples,
                      const MatchingOptions& options,
                      MatchMemory* memory = nullptr);

// How much of each surface is left unmatched, in [0, 1].
struct Unmatched {
  double source = 1.0;
  double target = 1.0;

  double Mean() const { return 0.5 * (source + target); }
};

// The mean over the samples of each surface of d^2 / (d^2 + width^2), with 1 where there is no
// closest point or the normals disagree; 1 without samples.
Unmatched FindUnmatched(const MovedSource& source,
                        const Surface& target,
                        const std::vector<int>& target_samples,
                        double width,
                        const MatchingOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_MATCHING_H_
