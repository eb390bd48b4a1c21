// The rigid part of a fit: where the source stands before anything bends.
#ifndef CERES_ED_REGISTRATION_RIGID_RIGID_REGISTRATION_H_
#define CERES_ED_REGISTRATION_RIGID_RIGID_REGISTRATION_H_

#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/geometry/surface.h>
#include <ceres_ed/registration/fit_options.h>

#include <functional>
#include <string>

namespace ceres_ed {

struct RigidResult {
  Similarity target_from_source;
  // In [0, 1]: how much is missed, mostly of the surface that is explained better (of a partial
  // target nearly all can be explained, of the whole source beside it little); 0 is a perfect fit.
  // RigidScore::Total over the points themselves.
  double score = 1.0;
  // Poses that were refined, the given one included.
  int starts_tried = 0;
};

// The pose that explains most of the surface that is explained better. Robust point-to-plane ICP
// (both directions, Geman-McClure with a width annealed to the spread of the residuals) refines
// poses on thinned out, smoothed surfaces (coarse_surface.h). The given pose comes first. Where it
// misses more than good_score, others follow: centroids aligned, with the given orientation and
// with the principal axes in their four ways, and what the search finds that lays the smaller
// surface on every part of the larger one (rigid_search.h). All are refined roughly, the best of
// them better; the winner replaces the given pose if it is better by `preference`. Last, ICP on the
// points themselves. Turns that leave the smaller surface equally well explained can't be told
// apart: a smooth part without features is found only up to a slide.
RigidResult AlignRigid(const Surface& source,
                       const Surface& target,
                       const Similarity& initial,
                       const RigidOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_RIGID_RIGID_REGISTRATION_H_
