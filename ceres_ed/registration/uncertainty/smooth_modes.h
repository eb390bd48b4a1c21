// Smooth displacement fields of a whole body, of which a deformation has some amount.
#ifndef CERES_ED_REGISTRATION_UNCERTAINTY_SMOOTH_MODES_H_
#define CERES_ED_REGISTRATION_UNCERTAINTY_SMOOTH_MODES_H_

#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/deformation_state.h>

#include <array>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The field u(x) = x^a y^b z^c e_axis, and its usual size.
struct SmoothMode {
  std::array<int, 3> powers = {0, 0, 0};
  int axis = 0;
  // The root mean square of its coefficient in a deformation: strain for a linear field, 1 / length
  // for a quadratic one.
  double amplitude = 0.0;

  double Value(const Eigen::Vector3d& x) const;
  Eigen::Vector3d Gradient(const Eigen::Vector3d& x) const;
};

// Returns all linear and quadratic fields. Their amplitudes are those of the deformation that
// `state` has at the observed nodes (nonzero in `is_observed`), fitted by least squares; a rotation
// is no strain. All are zero if no node is observed.
std::vector<SmoothMode> FindSmoothModes(const DeformationGraph& graph,
                                        const DeformationState& state,
                                        const std::vector<char>& is_observed);

// Returns the change of all nodes for one unit of a mode: A_j changes by grad u(g_j), and t_j by
// u(g_j). 12 values for each node, in the order of cost_functions/node_parameters.h.
Eigen::VectorXd NodeMotion(const SmoothMode& mode, const DeformationGraph& graph);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_UNCERTAINTY_SMOOTH_MODES_H_
