// The report of the evaluation of a pair.
#ifndef CERES_ED_PIPELINE_EVALUATE_PAIR_REPORT_H_
#define CERES_ED_PIPELINE_EVALUATE_PAIR_REPORT_H_

#include <ceres_ed/evaluation/covariance_calibration.h>
#include <ceres_ed/evaluation/pair_evaluation.h>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Returns all figures. Each set of distances is {"mean", "rms", "p50", "p95", "max", "trimmed",
// "mean_percent"}. A figure that was not computed is null.
nlohmann::ordered_json EvaluationReport(const Evaluation& evaluation);

// Returns {"all", "seen", "hidden"}, each with the members of Calibration or null, and "unknown".
nlohmann::ordered_json CalibrationReport(const CalibrationFigures& calibration);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_EVALUATE_PAIR_REPORT_H_
