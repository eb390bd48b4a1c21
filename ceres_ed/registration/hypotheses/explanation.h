// The measure that judges deformations: how much of the surfaces one leaves unexplained.
#ifndef CERES_ED_REGISTRATION_HYPOTHESES_EXPLANATION_H_
#define CERES_ED_REGISTRATION_HYPOTHESES_EXPLANATION_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/registration/matching.h>
#include <ceres_ed/registration/unit_fit.h>

namespace ceres_ed {

// Returns a mean of the unmatched shares in which the target has most of the weight, because it is
// all that is known, whereas much of the source may be hidden from it.
double MeanAmongWays(const Unmatched& unmatched);

// How well a deformation explains the two surfaces, and at what price.
struct Explanation {
  Unmatched unmatched;
  // The share of the source's area that is squeezed away (MovingSamples::LostArea).
  double lost_area = 0.0;
  // The change of length that a tenth of the source's area exceeds (MovingSamples::Stretch).
  double stretch = 0.0;

  // Returns what is left to explain when ways to follow the target are compared: the mean above,
  // and the price. A way that stretches the source, or squeezes it onto the target, has matched it
  // at no gain.
  double AmongWays() const;
  // Returns what is left to explain in the comparison with the rigid placement, in which the
  // surface that is explained better has most of the weight: what nobody sees is no evidence.
  double AgainstRigid() const { return unmatched.Total() + lost_area; }
};

// Measures `state` on `graph`, in the unit frame. A point at the distance `width` > 0 from the
// other surface counts half as unmatched. Without a target nothing is unmatched.
Explanation MeasureExplanation(const UnitFit& fit,
                               const BuiltGraph& graph,
                               const DeformationState& state,
                               double width);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_HYPOTHESES_EXPLANATION_H_
