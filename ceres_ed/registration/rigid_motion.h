// The rigid motion of a source, as a state of its nodes.
#ifndef CERES_ED_REGISTRATION_RIGID_MOTION_H_
#define CERES_ED_REGISTRATION_RIGID_MOTION_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/unit_fit.h>

#include <vector>

namespace ceres_ed {

// Returns the state of the nodes under the rigid motion that takes the points of `matches` nearest
// to their targets, in the mean square with the weights of the matches (Kabsch 1976). There must be
// a match with a positive weight.
DeformationState RigidMotion(const UnitFit& fit,
                             const BuiltGraph& graph,
                             const std::vector<Correspondence>& matches);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_RIGID_MOTION_H_
