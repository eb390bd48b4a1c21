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

}  // namespace

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
