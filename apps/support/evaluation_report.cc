#include "apps/support/evaluation_report.h"

#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/mesh/ply_document.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

using nlohmann::ordered_json;

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

ordered_json DistanceReport(const DistanceStatistics& distance, double diagonal) {
  return {{"mean", distance.mean},
          {"rms", distance.rms},
          {"p50", distance.p50},
          {"p95", distance.p95},
          {"max", distance.max},
          {"trimmed", distance.trimmed},
          {"mean_percent", distance.InPercentOf(diagonal).mean}};
}

ordered_json OrNull(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

// Blue over white to red for t in [0, 1].
std::array<std::uint8_t, 3> HeatColor(double t) {
  const auto channel = [](double value) {
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
  };
  return {channel(2.0 * t), channel(1.0 - std::abs(2.0 * t - 1.0)), channel(2.0 - 2.0 * t)};
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

Status WriteErrorCloud(const std::string& path,
                       const PointCloud& cloud,
                       const std::vector<double>& errors) {
  CHECK_EQ(errors.size(), cloud.size());
  const double full_scale = Summarize(errors).p95;
  CloudWriteOptions options;
  options.colors.reserve(errors.size());
  for (const double error : errors) {
    options.colors.push_back(HeatColor(full_scale > 0.0 ? std::min(error / full_scale, 1.0) : 0.0));
  }
  options.columns.push_back(MakePlyScalar("error", PlyType::kFloat32, errors));
  return WriteCloud(path, cloud, options);
}

}  // namespace ceres_ed
