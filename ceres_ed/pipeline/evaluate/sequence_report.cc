#include "ceres_ed/pipeline/evaluate/sequence_report.h"

#include <ceres_ed/evaluation/run_log.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ceres_ed {
namespace {

using nlohmann::ordered_json;

ordered_json StatisticsReport(const std::optional<DistanceStatistics>& distance) {
  if (!distance) return nullptr;
  return {{"mean", distance->mean},
          {"rms", distance->rms},
          {"p50", distance->p50},
          {"p95", distance->p95},
          {"p99", distance->p99},
          {"max", distance->max}};
}

ordered_json AcrossReport(const AcrossFrames& across) {
  if (across.frames == 0) return nullptr;
  return {{"mean", across.mean},
          {"median", across.median},
          {"max", across.max},
          {"frames", across.frames}};
}

ordered_json TruthReport(const std::vector<FrameTruthError>& errors) {
  if (errors.empty()) return nullptr;
  ordered_json summary = ordered_json::object();
  for (const TruthFigure& figure : kTruthFigures) {
    summary[figure.name] = AcrossReport(SummarizeTruth(errors, figure));
  }
  ordered_json frames = ordered_json::array();
  for (const FrameTruthError& error : errors) {
    ordered_json frame = {{"frame", error.frame},
                          {"points", error.points},
                          {"seen", error.seen},
                          {"unknown", error.unknown}};
    for (const TruthSet& set : kTruthSets) frame[set.name] = StatisticsReport(error.*set.set);
    frames.push_back(frame);
  }
  return {{"summary", summary}, {"frames", frames}};
}

ordered_json TrajectoryReport(const TrajectoryError& error) {
  ordered_json frames = ordered_json::array();
  for (const PoseError& frame : error.frames) {
    frames.push_back({{"frame", frame.frame},
                      {"translation", frame.translation},
                      {"rotation_deg", frame.rotation_deg}});
  }
  return {{"translation_rmse", error.translation_rmse},
          {"translation_mean", error.translation_mean},
          {"translation_median", error.translation_median},
          {"translation_max", error.translation_max},
          {"rotation_mean_deg", error.rotation_mean_deg},
          {"rotation_max_deg", error.rotation_max_deg},
          {"frames", frames}};
}

ordered_json DepthReport(const std::vector<DepthAgreement>& agreements) {
  if (agreements.empty()) return nullptr;
  ordered_json frames = ordered_json::array();
  for (const DepthAgreement& agreement : agreements) {
    frames.push_back(
        {{"frame", agreement.frame},
         {"points", agreement.points},
         {"seen", agreement.seen},
         {"measured", agreement.measured},
         {"residual", StatisticsReport(agreement.residual)},
         {"far_share", agreement.far_share ? ordered_json(*agreement.far_share) : nullptr}});
  }
  const auto across = [&agreements](double DistanceStatistics::*figure) {
    return AcrossReport(SummarizeDepth(agreements, figure));
  };
  return {{"summary",
           {{"residual_median", across(&DistanceStatistics::p50)},
            {"residual_p95", across(&DistanceStatistics::p95)},
            {"far_share", AcrossReport(SummarizeFarShare(agreements))}}},
          {"frames", frames}};
}

ordered_json TracksReport(const TrackEvaluation& tracks) {
  ordered_json frames = ordered_json::array();
  for (const TrackFrameError& frame : tracks.frames) {
    frames.push_back({{"frame", frame.frame},
                      {"tracks", frame.tracks},
                      {"lost", frame.lost},
                      {"error", StatisticsReport(frame.error)}});
  }
  return {{"tracks", tracks.tracks},
          {"followed", tracks.followed},
          {"late", tracks.late},
          {"lost", tracks.lost},
          {"error", StatisticsReport(tracks.error)},
          {"moved", tracks.moved},
          {"moved_error", StatisticsReport(tracks.moved_error)},
          {"frames", frames}};
}

ordered_json EndPointsReport(const EndPointError& error) {
  ordered_json within = ordered_json::object();
  for (std::size_t i = 0; i < kEndPointBounds.size(); ++i) {
    within[std::to_string(static_cast<int>(kEndPointBounds[i]))] = error.within[i];
  }
  return {{"points", error.points},
          {"followed", error.followed},
          {"error", StatisticsReport(error.error)},
          {"within_px", within}};
}

ordered_json LogReport(const FrameLog& log) {
  const LogSummary summary = SummarizeLog(log);
  ordered_json times = ordered_json::object();
  for (const auto& [name, seconds] : summary.median_times_s) times[name] = seconds;
  ordered_json report = {{"frames", log.frames.size()},
                         {"status", summary.frames_by_status},
                         {"rms_plane", AcrossReport(summary.rms_plane)},
                         {"median_time_s", times}};
  if (summary.rms_plane.frames > 0) report["rms_plane"]["last"] = summary.rms_plane_last;
  for (const auto& [name, value] : summary.at_the_end) report[name] = value;
  return report;
}

}  // namespace

ordered_json SequenceReport(const SequenceFigures& figures) {
  ordered_json report = {{"truth", TruthReport(figures.truth)},
                         {"camera", nullptr},
                         {"depth", DepthReport(figures.depth)},
                         {"tracks_2d", nullptr},
                         {"log", nullptr}};
  if (figures.camera) {
    report["camera"] = {{"from_first_frame", TrajectoryReport(figures.camera->from_first_frame)},
                        {"best_alignment", TrajectoryReport(figures.camera->best_alignment)}};
  }
  if (figures.tracks) report["tracks_2d"] = TracksReport(*figures.tracks);
  if (figures.end_points) report["end_points"] = EndPointsReport(*figures.end_points);
  for (const ScanAgreement& scan : figures.scans) {
    report["scans"].push_back({{"frame", scan.frame},
                               {"seen", scan.seen},
                               {"distance", StatisticsReport(scan.distance)}});
  }
  if (figures.log) report["log"] = LogReport(*figures.log);
  return report;
}

}  // namespace ceres_ed
