#include "ceres_ed/registration/hypotheses/explanation.h"

#include <ceres_ed/registration/moving_samples.h>
#include <ceres_ed/registration/nonrigid_loop.h>

namespace ceres_ed {
namespace {

// The weight of the target's unmatched share when ways are compared; the rest is the source's.
constexpr double kTargetShare = 0.8;
// The weight of the stretch.
constexpr double kStretchWeight = 0.25;
// The part of the area that is stretched less than the stretch.
constexpr double kStretchQuantile = 0.9;
// The number of source samples; it is large enough that each target sample has a source sample near
// it.
constexpr int kSourceSamples = 8000;

}  // namespace

double MeanAmongWays(const Unmatched& unmatched) {
  return kTargetShare * unmatched.target + (1.0 - kTargetShare) * unmatched.source;
}

double Explanation::AmongWays() const {
  return MeanAmongWays(unmatched) + lost_area + kStretchWeight * stretch;
}

Explanation MeasureExplanation(const UnitFit& fit,
                               const BuiltGraph& graph,
                               const DeformationState& state,
                               double width) {
  MovingSamples moving(*fit.source, graph, kSourceSamples);
  Explanation explanation;
  explanation.lost_area = moving.LostArea(state);
  explanation.stretch = moving.Stretch(state, kStretchQuantile);
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
