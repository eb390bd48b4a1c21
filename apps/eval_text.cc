#include "apps/eval_text.h"

#include <cstdio>

namespace ceres_ed {
namespace {

std::string TableRow(const char* name, const DistanceStatistics& distance, double diagonal) {
  char row[160];
  std::snprintf(row,
                sizeof(row),
                "%-28s %9.4g %9.4g %9.4g %9.4g %9.4g %9.4g %8.3f\n",
                name,
                distance.mean,
                distance.rms,
                distance.p50,
                distance.p95,
                distance.max,
                distance.trimmed,
                distance.InPercentOf(diagonal).mean);
  return row;
}

std::string Line(const char* format, double value) {
  char line[160];
  std::snprintf(line, sizeof(line), format, value);
  return line;
}

std::string CalibrationRow(const char* name, const std::optional<Calibration>& part) {
  if (!part) return "";
  char row[160];
  std::snprintf(row,
                sizeof(row),
                "%-28s %8d %8.1f %8.1f %8.1f %9.3f %6.2f %6.2f\n",
                name,
                part->points,
                100.0 * part->coverage_50,
                100.0 * part->coverage_80,
                100.0 * part->coverage_95,
                part->negative_log_likelihood,
                part->ause,
                part->rank_correlation);
  return row;
}

}  // namespace

std::string CalibrationTable(const CalibrationFigures& calibration) {
  char header[160];
  std::snprintf(header,
                sizeof(header),
                "%-28s %8s %8s %8s %8s %9s %6s %6s\n",
                "in ellipsoids of ... percent",
                "points",
                "50",
                "80",
                "95",
                "nll",
                "ause",
                "rank");
  std::string table = header + CalibrationRow("all", calibration.all) +
                      CalibrationRow("near the target", calibration.seen) +
                      CalibrationRow("hidden from the target", calibration.hidden);
  if (calibration.unknown > 0) {
    table += std::to_string(calibration.unknown) + " points have no covariance\n";
  }
  return table;
}

std::string EvaluationTable(const Evaluation& evaluation) {
  const double diagonal = evaluation.diagonal;
  char header[160];
  std::snprintf(header,
                sizeof(header),
                "%-28s %9s %9s %9s %9s %9s %9s %8s\n",
                "distance, unit of the input",
                "mean",
                "rms",
                "p50",
                "p95",
                "max",
                "trimmed",
                "mean %");
  std::string table = header + TableRow("result to target surface", evaluation.forward, diagonal) +
                      TableRow("target to result surface", evaluation.backward, diagonal) +
                      TableRow("symmetric", evaluation.symmetric, diagonal) +
                      TableRow("result to target vertices", evaluation.nearest_forward, diagonal) +
                      TableRow("target to result vertices", evaluation.nearest_backward, diagonal);
  if (evaluation.truth) table += TableRow("result to truth", *evaluation.truth, diagonal);
  table += Line("mean %% refers to the target's diagonal, %.4g\n", diagonal);
  if (evaluation.point_to_plane)
    table += Line("point to plane: %.4g\n", *evaluation.point_to_plane);
  if (evaluation.normal_error_deg) {
    table += Line("normal error: %.2f degrees\n", *evaluation.normal_error_deg);
  }
  if (evaluation.shape) {
    const ShapeChange& shape = *evaluation.shape;
    table += Line("edge length change: mean %.2f %%", 100.0 * shape.edge_mean) +
             Line(", p95 %.2f %%", 100.0 * shape.edge_p95) +
             Line(", p99 %.2f %%\n", 100.0 * shape.edge_p99) +
             "triangles flipped: " + std::to_string(shape.flipped) +
             ", degenerate: " + std::to_string(shape.degenerate) + "\n";
  }
  return table;
}

}  // namespace ceres_ed
