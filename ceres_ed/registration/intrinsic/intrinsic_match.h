// Matches between two surfaces that depend on lengths along them, not on their poses.
#ifndef CERES_ED_REGISTRATION_INTRINSIC_INTRINSIC_MATCH_H_
#define CERES_ED_REGISTRATION_INTRINSIC_INTRINSIC_MATCH_H_

#include <ceres_ed/energy/energy.h>
#include <ceres_ed/geometry/surface.h>

#include <functional>
#include <vector>

namespace ceres_ed {

// The matches of one map between two surfaces.
struct IntrinsicMatches {
  // Points of the source with positions on the target; weights are in [0, 1], and 0 where the map
  // contradicts itself.
  std::vector<Correspondence> correspondences;
  // See RankedMap and MapQuality.
  double cost = 0.0;
  double orientation = 0.5;
  double returning = 0.0;
};

// Returns the best maps of `source` onto `target`, the best first; none if the surfaces have no map
// that most points return from. Both surfaces are thinned out (CoarseMesh), and their largest parts
// are compared by their harmonics (SearchMaps). If both surfaces know their outer sides, a map that
// swaps left and right is left out; otherwise both maps are returned. The result does not depend on
// poses or units. If `should_stop` returns true, it is empty.
std::vector<IntrinsicMatches> MatchIntrinsically(const Surface& source,
                                                 const Surface& target,
                                                 const std::function<bool()>& should_stop = {});

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_INTRINSIC_INTRINSIC_MATCH_H_
