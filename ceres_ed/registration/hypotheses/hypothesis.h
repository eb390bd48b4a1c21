// The ways in which the coarse graphs of a fit may follow the target, as a table.
#ifndef CERES_ED_REGISTRATION_HYPOTHESES_HYPOTHESIS_H_
#define CERES_ED_REGISTRATION_HYPOTHESES_HYPOTHESIS_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/unit_fit.h>

#include <limits>
#include <string>
#include <vector>

namespace ceres_ed {

// Where the source is before a hypothesis bends it.
enum class HypothesisStart {
  // Where the rigid stage has placed it.
  kPlaced,
  // Where the input has it, turned and moved back from its place (UnitFit::given_from_placed).
  kGiven,
};

// One way to follow the target on the coarse graphs. Closest points lead each way along a path of
// its own, and none is right for all inputs.
struct Hypothesis {
  std::string name;
  HypothesisStart start = HypothesisStart::kPlaced;
  // The width of the data loss, as a multiple of the robust standard deviation of the residuals.
  double loss_width = 10.0;
  // The largest angle between the normals of a pair, in degrees.
  double max_angle_deg = 75.0;
  // No pair is farther apart than this part of the source's diagonal.
  double max_distance = std::numeric_limits<double>::infinity();
  // The factor of the stiffness in all steps.
  double stiffness = 1.0;
};

// Returns the names of all hypotheses, in the order in which they are tried.
std::vector<std::string> HypothesisNames();

// Returns an empty text if `names` (with commas between) are names of hypotheses, without any that
// is there twice; otherwise a sentence says what is wrong.
std::string CheckHypothesisNames(const std::string& names);

// Returns the hypotheses of `fit` in the order in which they are tried; there is at least one.
// FitOptions::hypotheses chooses among them. Without a target, or with a loss that has no width,
// there is only one way to follow it. The given pose is a start of its own only where the rigid
// stage has moved the source away from it.
std::vector<Hypothesis> ListHypotheses(const UnitFit& fit);

// Returns the state of `graph` from which `hypothesis` starts, in the unit frame. A rigid motion
// costs nothing in E_rot and E_reg.
DeformationState StartOf(const Hypothesis& hypothesis, const UnitFit& fit, const BuiltGraph& graph);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_HYPOTHESES_HYPOTHESIS_H_
