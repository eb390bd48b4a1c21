// The rigid part of a fit: the placement of the source before it deforms.
#ifndef CERES_ED_REGISTRATION_RIGID_RIGID_REGISTRATION_H_
#define CERES_ED_REGISTRATION_RIGID_RIGID_REGISTRATION_H_

#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/geometry/surface.h>
#include <ceres_ed/registration/fit_options.h>

#include <functional>
#include <string>

namespace ceres_ed {

// The result of a rigid alignment.
struct RigidResult {
  Similarity target_from_source;
  // How much is unmatched, in [0, 1]; 0 is a perfect fit. The surface that is explained better has
  // most of the weight: nearly all of a partial target can be explained, but little of the whole
  // source. This is RigidScore::Total() over the points themselves.
  double score = 1.0;
  // The score of the best one of the refined poses that differ from the result, as a multiple of
  // the score of the result; -1 if there is none.
  double runner_up = -1.0;
  // RigidAligner::LeastCurvature() at the result.
  double curvature = 0.0;
  // The number of poses that were refined, including the given one.
  int starts_tried = 0;
  // Whether the target is explained better inside out, with all its normals reversed.
  bool reversed = false;
};

// Returns the pose that explains most of the surface that is explained better.
//
// Robust point-to-plane ICP (both directions, Geman-McClure with a width that is reduced with the
// spread of the residuals) refines poses on thinned out, smoothed surfaces (coarse_surface.h). The
// given pose is refined first. If it misses more than good_score, other poses follow: aligned
// centroids with the given orientation and with the principal axes in their four proper ways, and
// the results of a search that lays the smaller surface onto every part of the larger one
// (rigid_search.h). All of them are refined roughly, and the best of them better. The best one
// replaces the given pose if it is better by the factor `preference`. Finally ICP runs on the
// points themselves.
//
// Where the given pose misses more than good_score and options.both_sides is set, the target is
// also taken inside out: first at the given pose, and if this does not tell the sides apart and no
// pose is good, in a search of its own. It is reversed if this is better by the factor
// `preference`.
//
// Rotations that explain the smaller surface equally well cannot be distinguished: a smooth part
// without features is located only up to sliding.
RigidResult AlignRigid(const Surface& source,
                       const Surface& target,
                       const Similarity& initial,
                       const RigidOptions& options);

// Returns whether at `target_from_source` the target is explained better inside out: by the factor
// `preference`.
bool IsReversedAt(const Surface& source,
                  const Surface& target,
                  const Similarity& target_from_source,
                  const RigidOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_RIGID_RIGID_REGISTRATION_H_
