// The verdict on a fit, from what can be seen without truth.
#ifndef CERES_ED_PIPELINE_FIT_FIT_VERDICT_H_
#define CERES_ED_PIPELINE_FIT_FIT_VERDICT_H_

#include <ceres_ed/pipeline/verdict.h>
#include <ceres_ed/registration/fit_types.h>

namespace ceres_ed {

// What a verdict needs besides the result of a fit.
struct FitVerdictInput {
  const FitResult* result = nullptr;
  // The diagonals of both clouds in their units; that of the target is 0 without a target.
  double source_diagonal = 0.0;
  double target_diagonal = 0.0;
  // The root mean square error of the landmarks, in the target's unit; 0 without landmarks.
  double landmark_rms = 0.0;
};

// Judges a fit. The bounds were chosen on the pairs of scripts/bench_verdict.py so that results
// with an error above 2 % of the diagonal, or above the best rigid motion, are doubtful or bad.
Verdict JudgeFit(const FitVerdictInput& input);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_FIT_FIT_VERDICT_H_
