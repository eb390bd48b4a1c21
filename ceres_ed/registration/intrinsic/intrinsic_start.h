// A start of the deformation that does not depend on the poses of the surfaces.
#ifndef CERES_ED_REGISTRATION_INTRINSIC_INTRINSIC_START_H_
#define CERES_ED_REGISTRATION_INTRINSIC_INTRINSIC_START_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/unit_fit.h>
#include <ceres_ed/util/status.h>

#include <vector>

namespace ceres_ed {

// A state that follows matches.
struct FollowedMatches {
  DeformationState state;
  // The mean distance between the points of the matches and their places, weighted, in the unit
  // frame. Where a map swaps two limbs, it tears the surface between them, which the nodes do not
  // follow.
  double misfit = 0.0;
};

// Moves the nodes of `graph` so that the source points of `matches` (at least one, with a positive
// weight) come near their places, in the unit frame. First all nodes take the rigid motion of the
// matches. Then E_rot and E_reg with the matches as observations of points are minimised from stiff
// to soft, with Welsch weights, so that matches lose their influence that contradict those around
// them. So limbs bend no more than they must; motions that were found for each node by itself would
// twist thin limbs, around which the matches are uncertain. Returns an error if the energies are
// unknown.
StatusOr<FollowedMatches> FollowMatches(const UnitFit& fit,
                                        const BuiltGraph& graph,
                                        std::vector<Correspondence> matches);

// Returns the states of `graph` in which the source follows the intrinsic matches of the surfaces
// (MatchIntrinsically), the one with the least misfit first, and at most one other with a similar
// misfit; none if there are no such matches.
std::vector<DeformationState> IntrinsicStarts(const UnitFit& fit, const BuiltGraph& graph);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_INTRINSIC_INTRINSIC_START_H_
