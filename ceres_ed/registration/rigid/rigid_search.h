// Candidates for a rigid alignment from anywhere.
#ifndef CERES_ED_REGISTRATION_RIGID_RIGID_SEARCH_H_
#define CERES_ED_REGISTRATION_RIGID_RIGID_SEARCH_H_

#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/registration/rigid/coarse_surface.h>

#include <functional>
#include <vector>

namespace ceres_ed {

struct RigidSearchOptions {
  // Of every pose; the search doesn't change it.
  double scale = 1.0;
  // Both surfaces have normals of known sign; else each anchor is tried both ways.
  bool oriented = true;
  // At most this many poses come back, >= 1.
  int max_count = 30;
  // Asked now and then; true ends the search with what is there.
  std::function<bool()> should_stop;
};

// Poses target_from_source that lay the smaller surface onto the larger one, best first, no two of
// them alike. Every few points of the larger one are tried as the place of each of a few anchors of
// the smaller one, normal on normal, in 24 turns about it; a grid around the larger surface tells
// how much of the smaller one then lies on it with the right normal. No features and no chance:
// smooth organs have no features to speak of.
std::vector<Similarity> SearchRigidly(const CoarseSurface& source,
                                      const CoarseSurface& target,
                                      const RigidSearchOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_RIGID_RIGID_SEARCH_H_
