// What ed_eval says of an Evaluation.
#ifndef CERES_ED_APPS_SUPPORT_EVALUATION_REPORT_H_
#define CERES_ED_APPS_SUPPORT_EVALUATION_REPORT_H_

#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Returns a table for people: one row a distance, in the unit of the input, with the mean in
// percent of the target's diagonal behind it.
std::string EvaluationTable(const Evaluation& evaluation);

// Returns the same figures for programs, each set as {"mean", "rms", "p50", "p95", "max",
// "trimmed", "mean_percent"}; null where there is no figure.
nlohmann::ordered_json EvaluationReport(const Evaluation& evaluation);

// Writes `cloud` with the property `error` = errors[i] (unit of the input) and colours from blue
// (0) over white to red (the 95th percentile and above).
Status WriteErrorCloud(const std::string& path,
                       const PointCloud& cloud,
                       const std::vector<double>& errors);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SUPPORT_EVALUATION_REPORT_H_
