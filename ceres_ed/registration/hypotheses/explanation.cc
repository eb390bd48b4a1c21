#include "ceres_ed/registration/hypotheses/explanation.h"

#include <ceres_ed/registration/moving_samples.h>
#include <ceres_ed/registration/nonrigid_loop.h>

namespace ceres_ed {
namespace {

// The weight of the target's unmatched share when ways are compared; the rest is the source's.
constexpr double kTargetShare = 0.8;
// The number of source samples; it is large enough that each target sample has a source sample near
// it.
constexpr int kSourceSamples = 8000;

}  // namespace

double Explanation::AmongWays() const {
  return kTargetShare * unmatched.target + (1.0 - kTargetShare) * unmatched.source + lost_area;
}

Explanation MeasureExplanation(const UnitFit& fit,
                               const BuiltGraph& graph,
                               const DeformationState& state,
                               double width) {
  MovingSamples moving(*fit.source, graph, kSourceSamples);
  Explanation explanation;
  explanation.lost_area = moving.LostArea(state);
  explanation.unmatched = {0.0, 0.0};
  if (fit.target == nullptr) return explanation;
  moving.Move(state, fit.options->num_threads);
  explanation.unmatched = FindUnmatched(moving.Moved(),
                                        *fit.target,
                                        SamplePoints(*fit.target, kMinCoarseSamples),
                                        width,
                                        fit.options->matching);
  return explanation;
}

}  // namespace ceres_ed
