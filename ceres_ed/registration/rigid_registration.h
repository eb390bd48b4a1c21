// The rigid part of a fit: where the source stands before anything bends.
#ifndef CERES_ED_REGISTRATION_RIGID_REGISTRATION_H_
#define CERES_ED_REGISTRATION_RIGID_REGISTRATION_H_

#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/registration/surface.h>

#include <functional>
#include <string>

namespace ceres_ed {

struct RigidOptions {
  // Also estimate a scale.
  bool with_scale = false;
  // No pair whose normals differ by more, in (0, 180] degrees.
  double max_angle_deg = 60.0;
  // Distance, as a fraction of the target's diagonal, at which a point counts half as missed when
  // starts are compared, > 0.
  double score_width = 0.03;
  // A start is good enough not to try the costlier ones when its score is below this, in [0, 1].
  double good_score = 0.1;
  // A start that is not the given pose must beat it by this factor to be preferred, in (0, 1]:
  // inputs of the same sensor are more often near their place than not.
  double preference = 0.85;
  // The result doesn't depend on it, >= 1.
  int num_threads = 1;
  // Asked between starts; true ends the search with the best so far.
  std::function<bool()> should_stop;

  bool IsValid(std::string* error) const;
};

struct RigidResult {
  Similarity target_from_source;
  // In [0, 1]: how much is missed, from both sides; 0 is a perfect fit. The robust mean of
  // d^2 / (d^2 + w^2) over points of both surfaces, with 1 where the normals disagree.
  double score = 1.0;
  // Of the pose that was given.
  double initial_score = 1.0;
  int starts_tried = 0;
};

// Robust point-to-plane ICP (both directions, Geman-McClure with a width annealed to the spread of
// the residuals) from the given pose and from aligned centroids; where these fail, from the four
// alignments of the principal axes and from the 24 rotations of a cube. The best score wins.
RigidResult AlignRigid(const Surface& source,
                       const Surface& target,
                       const Similarity& initial,
                       const RigidOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_RIGID_REGISTRATION_H_
