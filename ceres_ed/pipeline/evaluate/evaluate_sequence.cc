#include <ceres_ed/evaluation/sequence_files.h>
#include <ceres_ed/io/results/live_cloud_io.h>
#include <ceres_ed/pipeline/evaluate/evaluate_run.h>
#include <ceres_ed/pipeline/evaluate/sequence_report.h>
#include <ceres_ed/pipeline/look.h>
#include <ceres_ed/pipeline/report.h>
#include <ceres_ed/pipeline/report/run_reader.h>
#include <ceres_ed/pipeline/report/slam_run_files.h>
#include <ceres_ed/version.h>

#include <optional>
#include <string>
#include <vector>

namespace ceres_ed {
namespace {

constexpr SequenceEvaluationOptions kOptions;
constexpr TrackFollowingOptions kTrackOptions;

// Returns what follows the points of the first frame to the last one, where they are given again;
// nothing if they are not given.
std::optional<TrackFollower> FollowEndPoints(const SequenceFiles& sequence) {
  if (!sequence.end_points || sequence.end_points->end.empty() || sequence.index_of_frame.empty()) {
    return std::nullopt;
  }
  std::vector<TrackObservation> starts;
  const int first = sequence.index_of_frame.begin()->first;
  for (const Eigen::Vector2d& pixel : sequence.end_points->start) {
    starts.push_back({first, static_cast<int>(starts.size()), pixel});
  }
  return TrackFollower(sequence.camera, starts, kTrackOptions);
}

StatusOr<SequenceFigures> Measure(const SequenceFiles& sequence,
                                  const ResultFiles& result,
                                  RunObserver* observer,
                                  std::vector<std::string>* warnings) {
  const PinholeCamera& camera = sequence.camera;
  SequenceFigures figures;
  figures.log = result.log;
  std::optional<TruthEvaluator> truth;
  if (sequence.truth) truth.emplace(camera, *sequence.truth, kOptions);
  std::optional<TrackFollower> tracks;
  if (!sequence.tracks.empty()) tracks.emplace(camera, sequence.tracks, kTrackOptions);

  std::optional<TrackFollower> end_points = FollowEndPoints(sequence);

  const int total = static_cast<int>(result.live_paths.size());
  int done = 0;
  for (const auto& [frame, path] : result.live_paths) {
    const StatusOr<LiveSnapshot> snapshot = ReadLiveCloud(path, frame, warnings);
    if (!snapshot.ok()) return snapshot.status();
    if (truth) {
      const StatusOr<FrameTruthError> error = truth->Evaluate(*snapshot);
      if (!error.ok()) return Status::Error(path + ": " + error.status().message());
      figures.truth.push_back(*error);
    }
    const StatusOr<std::optional<DepthImage>> depth = sequence.LoadDepth(frame, warnings);
    if (!depth.ok()) return depth.status();
    if (*depth) figures.depth.push_back(CompareWithDepth(camera, *snapshot, **depth, kOptions));
    if (tracks) tracks->Add(*snapshot);
    const auto scan = sequence.scans.find(frame);
    if (scan != sequence.scans.end()) {
      figures.scans.push_back(CompareWithScan(camera, *snapshot, scan->second, kOptions));
    }
    if (end_points) {
      end_points->Add(*snapshot);
      if (frame == sequence.index_of_frame.rbegin()->first) {
        figures.end_points = CompareEndPoints(static_cast<int>(sequence.end_points->start.size()),
                                              end_points->Predict(*snapshot),
                                              sequence.end_points->end);
      }
    }
    observer->OnProgress(++done, total, "frame " + std::to_string(frame));
  }
  if (tracks) figures.tracks = tracks->Evaluate();
  if (!sequence.true_poses.empty() && !result.trajectory.empty()) {
    const auto evaluation = EvaluateTrajectory(result.trajectory, sequence.true_poses);
    if (evaluation.ok()) {
      figures.camera = *evaluation;
    } else {
      warnings->push_back("trajectory.txt: " + evaluation.status().message());
    }
  }
  return figures;
}

nlohmann::ordered_json OptionsReport() {
  return {{"max_birth_offset", kOptions.max_birth_offset},
          {"visibility_tolerance", kOptions.visibility_tolerance},
          {"track_neighbors", kTrackOptions.neighbors},
          {"track_max_distance", kTrackOptions.max_distance}};
}

// Writes page and picture of the run that was measured.
Status WriteLook(const EvalSettings& settings,
                 const LookOutputs& outputs,
                 const nlohmann::ordered_json& report) {
  if (outputs.empty()) return Status::Ok();
  const StatusOr<FinishedRun> run = ReadFinishedRun(settings.result);
  if (!run.ok()) return run.status();
  const SlamRunView files = ReadSlamRun(*run, settings.sequence, /*with_truth=*/true);
  return WriteSequenceLook(outputs, run->report, report, files.view);
}

}  // namespace

Outcome EvaluateSequence(const EvalSettings& settings, EvaluateObserver* observer) {
  if (Status status = PrepareLook({settings.html, settings.png}); !status.ok()) {
    return Outcome::BadInput(status);
  }
  const StatusOr<SequenceFiles> sequence = OpenSequenceFiles(settings.sequence);
  if (!sequence.ok()) return Outcome::BadInput(sequence.status());
  const StatusOr<ResultFiles> result =
      LoadResultFiles(settings.result, settings.sequence, *sequence);
  if (!result.ok()) return Outcome::BadInput(result.status());
  std::vector<std::string> warnings = result->warnings;
  warnings.insert(warnings.end(), sequence->warnings.begin(), sequence->warnings.end());
  const StatusOr<SequenceFigures> figures = Measure(*sequence, *result, observer, &warnings);
  if (!figures.ok()) return Outcome::BadInput(figures.status());

  for (const std::string& warning : warnings) observer->OnWarning(warning);
  const LookOutputs outputs = {settings.html, settings.png};
  if (!settings.report.empty() || !outputs.empty()) {
    nlohmann::ordered_json report = {{"program", "ed_eval"}, {"version", kVersion}};
    report["sequence"] = {{"path", settings.sequence}};
    report["result"] = {{"path", settings.result}, {"live_clouds", result->live_paths.size()}};
    report.update(SequenceReport(*figures));
    report["options"] = OptionsReport();
    report["warnings"] = warnings;
    report["flags"] = FlagsReport(settings.flags);
    Status status = settings.report.empty() ? Status::Ok() : WriteReport(settings.report, report);
    if (status.ok()) status = WriteLook(settings, outputs, report);
    if (!status.ok()) return Outcome::BadInput(status);
  }
  observer->OnSequence(*figures);
  return Outcome::Done();
}

}  // namespace ceres_ed
