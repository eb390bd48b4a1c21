// The ways in which the coarse graphs of a fit may follow the target, as a table.
#ifndef CERES_ED_REGISTRATION_HYPOTHESES_HYPOTHESIS_H_
#define CERES_ED_REGISTRATION_HYPOTHESES_HYPOTHESIS_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/nonrigid_loop.h>
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
  // Where lengths along the surfaces take it (IntrinsicStarts()), bent already.
  kIntrinsic,
};

// One way to follow the target. Closest points lead each way along a path of its own, and none is
// right for all inputs.
struct Hypothesis {
  std::string name;
  HypothesisStart start = HypothesisStart::kPlaced;
  // The width of the data loss, as a multiple of the robust standard deviation of the residuals.
  double loss_width = 10.0;
  // The largest angle between the normals of a pair, in degrees, on the coarse graphs and on the
  // finest one.
  double coarse_angle_deg = 75.0;
  double fine_angle_deg = 75.0;
  // The hypothesis is tried if the best one before it leaves at least this share of the surface
  // that is explained better unmatched, or, if so, where one surface shows only a part of the
  // other.
  double needed_above = 0.0;
  bool needed_if_partial = false;
  // It is also tried where this share of the other surface, with the area that is squeezed away, is
  // left: a limb that has not come to its place leaves a hole there.
  double needed_above_worse = std::numeric_limits<double>::infinity();
  // What the hypothesis must explain beyond others to be chosen: the given pose is believed where
  // the surfaces cannot tell it from another one.
  double handicap = 0.0;

  // Returns `plan` with the rules of this hypothesis; `is_finest` says for which graph it is.
  ResolutionPlan Apply(ResolutionPlan plan, bool is_finest) const;
};

// Returns the names of all hypotheses, in the order in which they are tried.
std::vector<std::string> HypothesisNames();

// Returns an empty text if `names` (with commas between) are names of hypotheses, without any that
// is there twice; otherwise a sentence says what is wrong.
std::string CheckHypothesisNames(const std::string& names);

// Returns the hypotheses of `fit` in the order in which they are tried; there is at least one.
// FitOptions::hypotheses chooses among them. Landmarks and fixed points say more than the intrinsic
// start, which is not tried beside them. Without a target, or with a loss that has no width,
// there is only one way to follow it. The given pose is a start of its own only where the rigid
// stage has moved the source away from it. Where this is far, a part of a smooth surface may fit in
// several places.
std::vector<Hypothesis> ListHypotheses(const UnitFit& fit);

// Returns the state of `graph` from which `hypothesis` starts, in the unit frame. A rigid motion
// costs nothing in E_rot and E_reg.
DeformationState StartOf(const Hypothesis& hypothesis, const UnitFit& fit, const BuiltGraph& graph);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_HYPOTHESES_HYPOTHESIS_H_
