// Whether the surfaces show a deformation at all, or a rigid motion explains them as well.
#ifndef CERES_ED_REGISTRATION_HYPOTHESES_MODEL_SELECTION_H_
#define CERES_ED_REGISTRATION_HYPOTHESES_MODEL_SELECTION_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/unit_fit.h>

#include <optional>

namespace ceres_ed {

// Returns the rigid motion of the nodes of `graph` that explains the surfaces as well as their
// deformation `state` does; none if the deformation explains more.
//
// The motion is the rest, or the rigid motion that is nearest to `state` on what the target shows,
// whichever leaves less. Let v be the mean squared distance across the surfaces of the pairs of one
// node, plus s^2, with s the part of such distances that says nothing: the noise, and what the
// meshes leave between themselves. The deformation explains more if v_rigid / v falls at any node
// by more than a factor, or in the mean of the logarithms over all pairs by more than another one:
// a dent is seen at few nodes, and a slight bend of the whole body at all of them, but little at
// each. This is a likelihood ratio for each node with its own variance, in which the factors stand
// for the parameters of a deformation; those of an information criterion suppose that residuals are
// independent, which neighbouring ones are not.
//
// Landmarks, fixed points and energies of the user ask for a deformation, so with them there is
// none.
std::optional<DeformationState> RigidModel(const UnitFit& fit,
                                           const BuiltGraph& graph,
                                           const DeformationState& state);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_HYPOTHESES_MODEL_SELECTION_H_
