// Evaluations of files: read, measure, tell.
#ifndef CERES_ED_PIPELINE_EVALUATE_EVALUATE_RUN_H_
#define CERES_ED_PIPELINE_EVALUATE_EVALUATE_RUN_H_

#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/evaluation/sequence_figures.h>
#include <ceres_ed/pipeline/evaluate/evaluate_settings.h>
#include <ceres_ed/pipeline/outcome.h>
#include <ceres_ed/pipeline/run_observer.h>

namespace ceres_ed {

// As of RunObserver, and with what was measured, when all files are written.
class EvaluateObserver : public RunObserver {
 public:
  virtual void OnPair(const Evaluation& /*evaluation*/) {}
  virtual void OnSequence(const SequenceFigures& /*figures*/) {}
};

// Measures a fitted surface against its target, or what a run has made of a sequence against all
// that the sequence knows. Returns how it ended.
Outcome RunEvaluation(const EvalSettings& settings, EvaluateObserver* observer);

// The two parts of it.
Outcome EvaluatePair(const EvalSettings& settings, EvaluateObserver* observer);
Outcome EvaluateSequence(const EvalSettings& settings, EvaluateObserver* observer);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_EVALUATE_EVALUATE_RUN_H_
