// The report of the evaluation of a pair.
#ifndef CERES_ED_PIPELINE_EVALUATE_PAIR_REPORT_H_
#define CERES_ED_PIPELINE_EVALUATE_PAIR_REPORT_H_

#include <ceres_ed/evaluation/pair_evaluation.h>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Returns every figure, each set of distances as {"mean", "rms", "p50", "p95", "max", "trimmed",
// "mean_percent"}; null where there is no figure.
nlohmann::ordered_json EvaluationReport(const Evaluation& evaluation);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_EVALUATE_PAIR_REPORT_H_
