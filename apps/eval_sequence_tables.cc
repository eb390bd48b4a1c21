#include "apps/eval_text.h"

#include <ceres_ed/evaluation/run_log.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>

namespace ceres_ed {
namespace {

constexpr double kMillimetresPerMetre = 1e3;
constexpr std::size_t kTableFrames = 12;

template <typename... Values>
std::string Line(const char* format, Values... values) {
  char line[200];
  std::snprintf(line, sizeof(line), format, values...);
  return line;
}

// Returns a cell of the table in millimetres, or a dash.
std::string Millimetres(const std::optional<double>& metres) {
  return metres ? Line(" %8.3f", kMillimetresPerMetre * *metres) : std::string("        -");
}

// Returns the indices of about a dozen of `count` rows. The last row is always among them.
std::vector<std::size_t> ThinnedRows(std::size_t count) {
  std::vector<std::size_t> rows;
  const std::size_t step = std::max<std::size_t>(1, count / kTableFrames);
  for (std::size_t i = 0; i < count; i += step) rows.push_back(i);
  if (!rows.empty() && rows.back() + 1 != count) rows.push_back(count - 1);
  return rows;
}

std::string TruthTable(const std::vector<FrameTruthError>& errors) {
  std::string table =
      "Against the truth, mm   |          surface           |           tracking\n"
      "                        | all        seen            | seen              hidden\n"
      "frame  points   seen    |   median   median      p95 |     mean   median     mean   "
      "median\n";
  const auto figure = [](const char* name) {
    return *std::find_if(
        std::begin(kTruthFigures), std::end(kTruthFigures), [name](const TruthFigure& candidate) {
          return std::string(candidate.name) == name;
        });
  };
  const TruthFigure columns[] = {figure("surface_all_median"),
                                 figure("surface_seen_median"),
                                 figure("surface_seen_p95"),
                                 figure("tracking_seen_mean"),
                                 figure("tracking_seen_median"),
                                 figure("tracking_hidden_mean"),
                                 figure("tracking_hidden_median")};
  const auto row = [&columns](const std::string& head, const auto& value_of) {
    std::string text = head;
    for (std::size_t c = 0; c < std::size(columns); ++c) {
      if (c == 0 || c == 3) text += " |";
      text += Millimetres(value_of(columns[c]));
    }
    return text + "\n";
  };
  for (const std::size_t i : ThinnedRows(errors.size())) {
    const FrameTruthError& error = errors[i];
    table += row(Line("%5d %7d %6d   ", error.frame, error.points, error.seen),
                 [&error](const TruthFigure& column) { return column.Of(error); });
  }
  for (const bool is_mean : {true, false}) {
    table += row(is_mean ? "mean over frames       " : "median over frames     ",
                 [&](const TruthFigure& column) -> std::optional<double> {
                   const AcrossFrames across = SummarizeTruth(errors, column);
                   if (across.frames == 0) return std::nullopt;
                   return is_mean ? across.mean : across.median;
                 });
  }
  std::size_t points = 0;
  std::size_t unknown = 0;
  for (const FrameTruthError& error : errors) {
    points += static_cast<std::size_t>(error.points);
    unknown += static_cast<std::size_t>(error.unknown);
  }
  const double share = points > 0 ? 100.0 * static_cast<double>(unknown) / points : 0.0;
  return table +
         Line("created too far from the tissue to be tracked: %.2f %% of the points\n", share);
}

std::string CameraTable(const TrajectoryEvaluation& camera) {
  std::string table =
      "Camera error (errors in the motions of camera and tissue can compensate each other)\n"
      "                      frames   rmse mm   mean mm    max mm  mean deg   max deg\n";
  for (const auto& [name, error] : {std::pair("from the first frame", &camera.from_first_frame),
                                    std::pair("best rigid alignment", &camera.best_alignment)}) {
    table += Line("%-21s %6zu %9.3f %9.3f %9.3f %9.3f %9.3f\n",
                  name,
                  error->frames.size(),
                  kMillimetresPerMetre * error->translation_rmse,
                  kMillimetresPerMetre * error->translation_mean,
                  kMillimetresPerMetre * error->translation_max,
                  error->rotation_mean_deg,
                  error->rotation_max_deg);
  }
  return table;
}

std::string DepthTable(const std::vector<DepthAgreement>& frames) {
  std::string table =
      "Against the depth images, mm along the optical axis\n"
      "frame  points   seen measured    median      p95\n";
  for (const std::size_t i : ThinnedRows(frames.size())) {
    const DepthAgreement& frame = frames[i];
    std::optional<double> median, p95;
    if (frame.residual) median = frame.residual->p50;
    if (frame.residual) p95 = frame.residual->p95;
    table += Line("%5d %7d %6d   %6d ", frame.frame, frame.points, frame.seen, frame.measured) +
             Millimetres(median) + Millimetres(p95) + "\n";
  }
  const AcrossFrames median = SummarizeDepth(frames, &DistanceStatistics::p50);
  const AcrossFrames p95 = SummarizeDepth(frames, &DistanceStatistics::p95);
  if (median.frames == 0) return table;
  table += "mean over frames              " + Millimetres(median.mean) + Millimetres(p95.mean);
  table +=
      "\nmedian over frames            " + Millimetres(median.median) + Millimetres(p95.median);
  const AcrossFrames far = SummarizeFarShare(frames);
  return table + Line(
                     "\nfarther than %g mm from the depth: %.2f %% of the measured points in the "
                     "mean over frames, %.2f %% in the worst one\n",
                     kMillimetresPerMetre * SequenceEvaluationOptions().far_residual,
                     100.0 * far.mean,
                     100.0 * far.max);
}

std::string TrackText(const TrackEvaluation& tracks) {
  std::string text =
      Line("Tracks in the picture: %d of %d followed (%d only from a later frame on, ",
           tracks.followed,
           tracks.tracks,
           tracks.late) +
      Line("%d lost by the map in some frame)\n", tracks.lost);
  if (!tracks.error) return text;
  text += Line("  error median %.2f px, mean %.2f, p95 %.2f, max %.2f\n",
               tracks.error->p50,
               tracks.error->mean,
               tracks.error->p95,
               tracks.error->max);
  if (!tracks.moved_error) return text;
  return text + Line("  %d moved far: error at their ends median %.2f px, max %.2f\n",
                     tracks.moved,
                     tracks.moved_error->p50,
                     tracks.moved_error->max);
}

std::string EndPointText(const EndPointError& points) {
  std::string text = Line("Points of the first frame in the last one: %d of %d followed\n",
                          points.followed,
                          points.points);
  if (!points.error) return text;
  text += Line("  to the nearest given point: median %.2f px, mean %.2f, max %.2f; within",
               points.error->p50,
               points.error->mean,
               points.error->max);
  for (std::size_t i = 0; i < kEndPointBounds.size(); ++i) {
    text += Line(" %.0f px %.0f %%", kEndPointBounds[i], 100.0 * points.within[i]);
    text += i + 1 < kEndPointBounds.size() ? "," : "\n";
  }
  return text;
}

std::string ScanText(const ScanAgreement& scan) {
  if (!scan.distance) return Line("Scan of frame %d: no map point is seen\n", scan.frame);
  return Line("Scan of frame %d: %d map points, mm to it: median", scan.frame, scan.seen) +
         Millimetres(scan.distance->p50) + ", p95" + Millimetres(scan.distance->p95) + "\n";
}

std::string LogText(const FrameLog& log) {
  const LogSummary summary = SummarizeLog(log);
  std::string text = Line("Log of the run: %zu frames:", log.frames.size());
  for (const auto& [status, count] : summary.frames_by_status) {
    text += Line(" %d %s,", count, status.c_str());
  }
  text.back() = '\n';
  if (summary.rms_plane.frames > 0) {
    text += "  rms point to plane, mm: mean" + Millimetres(summary.rms_plane.mean) + ", median" +
            Millimetres(summary.rms_plane.median) + ", last" + Millimetres(summary.rms_plane_last) +
            "\n";
  }
  if (!summary.median_times_s.empty()) {
    text += "  median ms a frame:";
    for (const auto& [name, seconds] : summary.median_times_s) {
      text += Line(" %s %.1f", name.c_str() + 2, 1e3 * seconds);
    }
    text += "\n";
  }
  if (!summary.at_the_end.empty()) {
    text += "  at the end:";
    for (const auto& [name, value] : summary.at_the_end)
      text += Line(" %s %.0f", name.c_str(), value);
    text += "\n";
  }
  return text;
}

}  // namespace

std::string SequenceTables(const SequenceFigures& figures) {
  std::string text;
  const auto append = [&text](const std::string& part) {
    text += (text.empty() ? "" : "\n") + part;
  };
  if (!figures.truth.empty()) append(TruthTable(figures.truth));
  if (figures.camera) append(CameraTable(*figures.camera));
  if (!figures.depth.empty()) append(DepthTable(figures.depth));
  if (figures.tracks) append(TrackText(*figures.tracks));
  if (figures.end_points) append(EndPointText(*figures.end_points));
  for (const ScanAgreement& scan : figures.scans) append(ScanText(scan));
  if (figures.log) append(LogText(*figures.log));
  return text;
}

}  // namespace ceres_ed
