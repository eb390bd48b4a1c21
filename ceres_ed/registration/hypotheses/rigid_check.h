// The check that a fit is never worse than no deformation.
#ifndef CERES_ED_REGISTRATION_HYPOTHESES_RIGID_CHECK_H_
#define CERES_ED_REGISTRATION_HYPOTHESES_RIGID_CHECK_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/unit_fit.h>

#include <string>

namespace ceres_ed {

// Returns why the deformation `state` of `graph` is worse than the rigid placement, as a sentence;
// an empty text if it is not, that is, if it leaves no more of the surfaces unexplained. With
// energies of the user, which may ask for something else, it must leave clearly more. Landmarks and
// fixed points are given by the user and are kept, whatever they do to the surfaces.
std::string WhyRigidIsBetter(const UnitFit& fit,
                             const BuiltGraph& graph,
                             const DeformationState& state);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_HYPOTHESES_RIGID_CHECK_H_
