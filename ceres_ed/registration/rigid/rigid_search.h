// Finds candidates for a rigid alignment without an initial pose.
#ifndef CERES_ED_REGISTRATION_RIGID_RIGID_SEARCH_H_
#define CERES_ED_REGISTRATION_RIGID_RIGID_SEARCH_H_

#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/registration/rigid/coarse_surface.h>

#include <functional>
#include <vector>

namespace ceres_ed {

// Options of SearchRigidly().
struct RigidSearchOptions {
  // The scale of all poses; the search does not change it. Default 1.
  double scale = 1.0;
  // Whether the sign of the normals of both surfaces is known; otherwise each anchor is tried with
  // both signs. Default true.
  bool oriented = true;
  // Whether the normals of the target are taken the other way round; default false.
  bool reversed = false;
  // The largest number of poses to return, >= 1; default 30.
  int max_count = 30;
  // Called from time to time; if it returns true, the search ends with the poses found so far.
  std::function<bool()> should_stop;
};

// Returns poses target_from_source that lay the smaller surface onto the larger one, the best
// first, without poses that are nearly equal.
//
// A few anchors of the smaller surface are placed on evenly distributed points of the larger one,
// with aligned normals and in 24 rotations about the normal. A grid around the larger surface then
// gives the share of the smaller surface that lies on it with the correct normal. The search uses
// no features, because smooth organs have few, and no random numbers.
std::vector<Similarity> SearchRigidly(const CoarseSurface& source,
                                      const CoarseSurface& target,
                                      const RigidSearchOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_RIGID_RIGID_SEARCH_H_
