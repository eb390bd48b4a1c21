#include "ceres_ed/pipeline/evaluate/pair_report.h"

#include <optional>

namespace ceres_ed {
namespace {

using nlohmann::ordered_json;

ordered_json DistanceReport(const DistanceStatistics& distance, double diagonal) {
  return {{"mean", distance.mean},
          {"rms", distance.rms},
          {"p50", distance.p50},
          {"p95", distance.p95},
          {"p99", distance.p99},
          {"max", distance.max},
          {"trimmed", distance.trimmed},
          {"mean_percent", distance.InPercentOf(diagonal).mean}};
}

ordered_json OrNull(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json PartReport(const std::optional<Calibration>& part) {
  if (!part) return nullptr;
  return {{"points", part->points},
          {"coverage_50", part->coverage_50},
          {"coverage_80", part->coverage_80},
          {"coverage_95", part->coverage_95},
          {"reliability", part->reliability},
          {"negative_log_likelihood", part->negative_log_likelihood},
          {"ause", part->ause},
          {"rank_correlation", part->rank_correlation}};
}

}  // namespace

ordered_json CalibrationReport(const CalibrationFigures& calibration) {
  return {{"all", PartReport(calibration.all)},
          {"seen", PartReport(calibration.seen)},
          {"hidden", PartReport(calibration.hidden)},
          {"unknown", calibration.unknown}};
}

ordered_json EvaluationReport(const Evaluation& evaluation) {
  const double diagonal = evaluation.diagonal;
  ordered_json report = {
      {"diagonal", diagonal},
      {"forward", DistanceReport(evaluation.forward, diagonal)},
      {"backward", DistanceReport(evaluation.backward, diagonal)},
      {"symmetric", DistanceReport(evaluation.symmetric, diagonal)},
      {"nearest_forward", DistanceReport(evaluation.nearest_forward, diagonal)},
      {"nearest_backward", DistanceReport(evaluation.nearest_backward, diagonal)},
      {"point_to_plane", OrNull(evaluation.point_to_plane)},
      {"normal_error_deg", OrNull(evaluation.normal_error_deg)},
      {"truth", nullptr},
      {"shape", nullptr}};
  if (evaluation.truth) report["truth"] = DistanceReport(*evaluation.truth, diagonal);
  if (evaluation.shape) {
    const ShapeChange& shape = *evaluation.shape;
    report["shape"] = {{"edge_mean", shape.edge_mean},
                       {"edge_p95", shape.edge_p95},
                       {"edge_p99", shape.edge_p99},
                       {"edges", shape.edges},
                       {"flipped", shape.flipped},
                       {"degenerate", shape.degenerate}};
  }
  return report;
}

}  // namespace ceres_ed
