// The tables that ed_eval prints.
#ifndef CERES_ED_APPS_EVAL_TEXT_H_
#define CERES_ED_APPS_EVAL_TEXT_H_

#include <ceres_ed/evaluation/covariance_calibration.h>
#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/evaluation/sequence_figures.h>

#include <string>

namespace ceres_ed {

// Returns the table of a pair. It has a row for each set of distances, in the unit of the input,
// which ends with the mean in percent of the target's diagonal.
std::string EvaluationTable(const Evaluation& evaluation);

// Returns the table of covariances against errors: a row each for all, seen and hidden points.
std::string CalibrationTable(const CalibrationFigures& calibration);

// Returns the tables of a sequence in millimetres, pixels and degrees: all parts that were
// measured, with about a dozen frames and the statistics over all frames.
std::string SequenceTables(const SequenceFigures& figures);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_EVAL_TEXT_H_
