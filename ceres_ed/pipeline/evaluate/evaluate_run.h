// Evaluates files: reads them, measures, and reports the figures.
#ifndef CERES_ED_PIPELINE_EVALUATE_EVALUATE_RUN_H_
#define CERES_ED_PIPELINE_EVALUATE_EVALUATE_RUN_H_

#include <ceres_ed/evaluation/covariance_calibration.h>
#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/evaluation/sequence_figures.h>
#include <ceres_ed/pipeline/evaluate/evaluate_settings.h>
#include <ceres_ed/pipeline/outcome.h>
#include <ceres_ed/pipeline/run_observer.h>

namespace ceres_ed {

// A RunObserver that also receives the figures, after all files have been written.
class EvaluateObserver : public RunObserver {
 public:
  virtual void OnPair(const Evaluation& /*evaluation*/) {}
  // Follows OnPair() if covariances were given.
  virtual void OnCalibration(const CalibrationFigures& /*calibration*/) {}
  virtual void OnSequence(const SequenceFigures& /*figures*/) {}
};

// Measures a fitted surface against its target, or the result of a run on a sequence against
// everything that is known about the sequence. Returns how the evaluation ended.
Outcome RunEvaluation(const EvalSettings& settings, EvaluateObserver* observer);

// Evaluate a pair or a sequence. RunEvaluation() calls one of them after it has checked the
// outputs.
Outcome EvaluatePair(const EvalSettings& settings, EvaluateObserver* observer);
Outcome EvaluateSequence(const EvalSettings& settings, EvaluateObserver* observer);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_EVALUATE_EVALUATE_RUN_H_
