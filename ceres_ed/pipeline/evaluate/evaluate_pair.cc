#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/results/error_cloud.h>
#include <ceres_ed/pipeline/evaluate/evaluate_run.h>
#include <ceres_ed/pipeline/evaluate/pair_report.h>
#include <ceres_ed/pipeline/intention.h>
#include <ceres_ed/pipeline/look.h>
#include <ceres_ed/pipeline/outputs.h>
#include <ceres_ed/pipeline/report.h>
#include <ceres_ed/pipeline/run_command.h>
#include <ceres_ed/preflight/compare_sizes.h>
#include <ceres_ed/version.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ceres_ed {
namespace {

// Warns of what the reader says about the format of the file.
Status Load(const std::string& path, EvaluateObserver* observer, PointCloud* cloud) {
  if (path.empty()) return Status::Ok();
  StatusOr<LoadedCloud> loaded = LoadSurface(path);
  if (!loaded.ok()) return loaded.status();
  for (const std::string& warning : loaded->document.warnings) {
    observer->OnWarning(path + ": " + warning);
  }
  *cloud = std::move(loaded->cloud);
  return Status::Ok();
}

// Compares the covariances in settings.calibration with the errors. What lies within 1 % of the
// target's diagonal of the target is seen.
StatusOr<CalibrationFigures> Calibrate(const EvalSettings& settings,
                                       const PointCloud& result,
                                       const PointCloud& truth,
                                       const PointCloud& target,
                                       double diagonal) {
  constexpr double kSeenWithin = 0.01;
  const StatusOr<std::vector<Eigen::Matrix3d>> covariances = ReadCovariances(settings.calibration);
  if (!covariances.ok()) return covariances.status();
  if (covariances->size() != result.size()) {
    return Status::Error(settings.calibration + ": " + std::to_string(covariances->size()) +
                         " vertices, expected " + std::to_string(result.size()) + " as in " +
                         settings.fitted);
  }
  std::vector<Eigen::Vector3d> errors = result.points;
  for (std::size_t p = 0; p < errors.size(); ++p) errors[p] -= truth.points[p];
  std::vector<char> is_seen;
  for (const double distance : SurfaceDistances(truth.points, target)) {
    is_seen.push_back(distance <= kSeenWithin * diagonal ? 1 : 0);
  }
  return MeasureCalibration(errors, *covariances, is_seen);
}

}  // namespace

Outcome RunEvaluation(const EvalSettings& settings, EvaluateObserver* observer) {
  const Status possible = CheckLookOutputs({settings.html, settings.png});
  if (!possible.ok()) return Outcome::BadInput(possible);
  for (const std::string& output :
       {settings.report, settings.error_ply, settings.html, settings.png}) {
    if (output.empty()) continue;
    if (Status status = PrepareOutput(output); !status.ok()) return Outcome::BadInput(status);
  }
  return settings.is_sequence() ? EvaluateSequence(settings, observer)
                                : EvaluatePair(settings, observer);
}

Outcome EvaluatePair(const EvalSettings& settings, EvaluateObserver* observer) {
  PointCloud result, target, source, truth_cloud;
  for (const Status& status : {Load(settings.fitted, observer, &result),
                               Load(settings.target, observer, &target),
                               Load(settings.source, observer, &source),
                               Load(settings.truth, observer, &truth_cloud)}) {
    if (!status.ok()) return Outcome::BadInput(status);
  }
  for (const auto& [name, cloud] : {std::pair(&settings.target, &target),
                                    std::pair(&settings.source, &source),
                                    std::pair(&settings.truth, &truth_cloud)}) {
    const auto mismatch =
        CompareSizes({settings.fitted, Diagonal(result.points)}, {*name, Diagonal(cloud->points)});
    if (mismatch.has_value()) observer->OnWarning(mismatch->text);
  }
  const PointCloud* truth = settings.truth.empty() ? nullptr : &truth_cloud;
  const StatusOr<Evaluation> evaluation =
      Evaluate(result, target, settings.source.empty() ? nullptr : &source, truth);
  if (!evaluation.ok()) return Outcome::BadInput(evaluation.status());
  std::optional<CalibrationFigures> calibration;
  if (!settings.calibration.empty()) {
    StatusOr<CalibrationFigures> measured =
        Calibrate(settings, result, *truth, target, evaluation->diagonal);
    if (!measured.ok()) return Outcome::BadInput(measured.status());
    calibration = *std::move(measured);
  }

  nlohmann::ordered_json report = {{"program", "ed_eval"}, {"version", kVersion}};
  report["result"] = {{"path", settings.fitted}, {"points", result.size()}};
  report["target"] = {{"path", settings.target}, {"points", target.size()}};
  report.update(EvaluationReport(*evaluation));
  if (calibration) report["calibration"] = CalibrationReport(*calibration);
  report["flags"] = FlagsReport(settings.flags);
  report["flags_given"] = GivenFlagsReport(settings.flags);
  report["command"] = CommandText("ed_eval", {settings.fitted, settings.target}, settings.flags);
  if (!settings.report.empty()) {
    if (Status status = WriteReport(settings.report, report); !status.ok()) {
      return Outcome::BadInput(status);
    }
  }
  if (!settings.html.empty() || !settings.png.empty()) {
    FitParts parts;
    parts.source = settings.source.empty() ? nullptr : &source;
    parts.target = &target;
    parts.result = &result.points;
    parts.triangles = source.HasTriangles() ? &source.triangles : &result.triangles;
    parts.truth = truth != nullptr ? &truth->points : nullptr;
    // The diagonal stands with the target in the report of a fit.
    report["target"]["diagonal"] = evaluation->diagonal;
    Status status = WriteFitLook({settings.html, settings.png}, report, MakeFitView(parts));
    if (!status.ok()) return Outcome::BadInput(status);
  }
  if (!settings.error_ply.empty()) {
    const std::vector<double> errors =
        truth != nullptr ? PointDistances(result, *truth) : SurfaceDistances(result.points, target);
    std::vector<std::string> losses;
    Status status =
        WriteErrorCloud(settings.error_ply, result, errors, Summarize(errors).p95, &losses);
    if (!status.ok()) return Outcome::BadInput(status);
    for (const std::string& loss : losses) observer->OnWarning(loss);
  }
  observer->OnPair(*evaluation);
  if (calibration) observer->OnCalibration(*calibration);
  return Outcome::Done();
}

}  // namespace ceres_ed
