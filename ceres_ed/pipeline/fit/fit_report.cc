#include "ceres_ed/pipeline/fit/fit_report.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/linear_algebra/linear_algebra_backend.h>
#include <ceres_ed/pipeline/check/check_files.h>
#include <ceres_ed/pipeline/energies.h>
#include <ceres_ed/pipeline/fit/fit_verdict.h>
#include <ceres_ed/pipeline/report.h>
#include <ceres_ed/pipeline/run_command.h>
#include <ceres_ed/version.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace ceres_ed {
namespace {

using nlohmann::ordered_json;

ordered_json CloudReport(const CloudFile& file) {
  if (file.path.empty()) return nullptr;
  return {{"path", file.path},
          {"points", file.points},
          {"faces", file.faces},
          {"diagonal", file.diagonal}};
}

ordered_json NodesReport(const FitResult& result) {
  const int total = result.warp.graph.num_nodes();
  const int pr = NumPointRelevant(result);
  return {
      {"total", total}, {"pr", pr}, {"pi", total - pr}, {"edges", result.warp.graph.num_edges()}};
}

// Returns which PI nodes Level I moved, and what it cost to hold the others.
ordered_json ActiveSetReport(const StrategyOptions& strategy, const FitResult& result) {
  if (strategy.mode != SolveMode::kTwoLevel) return nullptr;
  const auto known = [](double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
  };
  const bool by_information = strategy.active == ActiveSetRule::kInformation;
  return {{"rule", NameOf(strategy.active)},
          {"pi", result.active_hidden},
          {"bound", by_information ? ordered_json(strategy.active_bound) : ordered_json(nullptr)},
          {"held_share", known(result.held_share)},
          {"information_lost", known(result.information_lost)}};
}

// Returns a name for a term that `terms` does not have: a user may add an energy with the name of
// another one, and then the names get numbers.
std::string FreeName(const ordered_json& terms, const std::string& label) {
  std::string name = label;
  for (int copy = 2; terms.contains(name); ++copy) name = label + "_" + std::to_string(copy);
  return name;
}

ordered_json RoundsReport(const std::vector<FitRound>& rounds) {
  ordered_json report = ordered_json::array();
  for (const FitRound& round : rounds) {
    ordered_json terms = ordered_json::object();
    for (const TermEnergy& term : round.energy.terms) {
      terms[FreeName(terms, term.label)] = term.weighted;
    }
    report.push_back({{"stiffness", round.stiffness},
                      {"inliers", round.inliers},
                      {"rms_plane", round.rms_plane},
                      {"total", round.energy.Total()},
                      {"terms", terms}});
  }
  return report;
}

ordered_json EnergyReport(const FitResult& result) {
  ordered_json terms = ordered_json::object();
  for (const TermEnergy& term : result.final_energy.terms) {
    terms[FreeName(terms, term.label)] = {
        {"weighted", term.weighted}, {"raw", term.raw}, {"residuals", term.residuals}};
  }
  return {{"initial", result.initial_energy.Total()},
          {"final", result.final_energy.Total()},
          {"terms", terms},
          {"rounds", RoundsReport(result.rounds)}};
}

// Returns null if the covariance was not requested or could not be computed.
ordered_json CovarianceReport(const FitUncertainty& uncertainty) {
  if (uncertainty.covariances.empty()) return nullptr;
  std::vector<double> known;
  for (const double deviation : uncertainty.StandardDeviations()) {
    if (std::isfinite(deviation)) known.push_back(deviation);
  }
  ordered_json report = ordered_json::object();
  if (!known.empty()) {
    std::sort(known.begin(), known.end());
    double sum = 0.0;
    for (const double deviation : known) sum += deviation;
    const auto quantile = [&known](double share) {
      return known[static_cast<std::size_t>(share * static_cast<double>(known.size() - 1))];
    };
    report = {{"mean", sum / static_cast<double>(known.size())},
              {"median", quantile(0.5)},
              {"p95", quantile(0.95)},
              {"max", known.back()}};
  }
  report["undetermined_points"] = uncertainty.covariances.size() - known.size();
  report["undetermined_nodes"] = uncertainty.undetermined_nodes;
  report["scale"] = FitUncertainty::kScale;
  report["time_s"] = uncertainty.time;
  return report;
}

ordered_json CoverReport(const CoverEvidence& cover) {
  return {{"matched", cover.matched}, {"missed", cover.missed}, {"unseen", cover.unseen}};
}

ordered_json UnmatchedReport(const FitEvidence& evidence) {
  if (!evidence.measured) return nullptr;
  return {{"source", evidence.source.Unmatched()}, {"target", evidence.target.Unmatched()}};
}

ordered_json EvidenceReport(const FitEvidence& evidence) {
  if (!evidence.measured) return nullptr;
  return {{"source", CoverReport(evidence.source)},
          {"target", CoverReport(evidence.target)},
          {"residual", evidence.residual},
          {"noise", evidence.noise},
          {"edge_stretch", evidence.edge_stretch},
          {"node_stretch", evidence.node_stretch},
          {"folded", evidence.folded},
          {"bend", evidence.bend},
          {"bend_matched", evidence.bend_matched},
          {"relief", evidence.relief},
          {"rigid_score", evidence.rigid_score},
          {"rigid_runner_up", evidence.rigid_runner_up},
          {"rigid_curvature", evidence.rigid_curvature},
          {"disagreement", evidence.disagreement}};
}

ordered_json RigidReport(const Similarity& rigid) {
  constexpr double kDegreesPerRadian = 180.0 / M_PI;
  const double angle = Eigen::AngleAxisd(rigid.rotation).angle();
  const Eigen::Vector3d& translation = rigid.translation;
  return {{"rotation_deg", std::min(angle, 2.0 * M_PI - angle) * kDegreesPerRadian},
          {"translation", {translation.x(), translation.y(), translation.z()}},
          {"scale", rigid.scale}};
}

ordered_json Numbers(const Eigen::Vector3d& point) { return {point.x(), point.y(), point.z()}; }

// Returns the figures of all landmarks; with their names if they have some.
ordered_json LandmarksReport(const FitRun& run) {
  const LandmarkErrors constraints = MeasureLandmarks(run);
  ordered_json report = {
      {"count", constraints.count}, {"rms", constraints.rms}, {"max", constraints.max}};
  const NamedLandmarks& named = run.files->named;
  if (named.pairs.empty()) return report;
  report["use"] = NameOf(run.settings->landmark_use);
  report["only_source"] = named.only_source;
  report["only_target"] = named.only_target;
  const std::vector<LandmarkError> errors = MeasureNamedLandmarks(run);
  for (const auto& [name, kind] : {std::pair("before", &LandmarkError::before),
                                   std::pair("rigid", &LandmarkError::rigid),
                                   std::pair("after", &LandmarkError::after)}) {
    const LandmarkErrors summary = SummarizeLandmarks(errors, kind);
    report[name] = {{"rms", summary.rms}, {"max", summary.max}};
  }
  ordered_json pairs = ordered_json::array();
  for (std::size_t i = 0; i < errors.size(); ++i) {
    pairs.push_back({{"name", named.pairs[i].name},
                     {"source", Numbers(named.pairs[i].source)},
                     {"target", Numbers(named.pairs[i].target)},
                     {"before", errors[i].before},
                     {"rigid", errors[i].rigid},
                     {"after", errors[i].after}});
  }
  report["pairs"] = std::move(pairs);
  return report;
}

ordered_json DisplacementReport(const FitRun& run) {
  double sum = 0.0;
  double max = 0.0;
  const std::vector<Eigen::Vector3d>& points = run.result->points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double distance = (points[i] - run.files->input.source.points[i]).norm();
    sum += distance;
    max = std::max(max, distance);
  }
  return {{"mean", points.empty() ? 0.0 : sum / static_cast<double>(points.size())}, {"max", max}};
}

ordered_json StagesReport(const FitTimes& times) {
  return {{"rigid", times.rigid},
          {"prepare", times.prepare},
          {"graph", times.graph},
          {"associate", times.associate},
          {"build", times.build},
          {"solve", times.solve},
          {"finish", times.finish}};
}

ordered_json TimeReport(const FitRun& run) {
  const FitTimes& times = run.result->times;
  const bool has_levels = run.settings->options.strategy.mode != SolveMode::kBatch;
  return {{"total", run.total_s},
          {"load", run.load_s},
          {"rigid", times.rigid},
          {"prepare", times.prepare},
          {"graph", times.graph},
          {"associate", times.associate},
          {"build", times.build},
          {"solve", times.solve},
          {"level1", has_levels ? times.level1 : 0.0},
          {"level2", has_levels ? times.level2 : 0.0},
          {"finish", times.finish},
          {"write", run.write_s}};
}

// Returns the user's energies that have no residuals at the end of the fit.
std::vector<std::string> IdleEnergies(const FitRun& run) {
  std::vector<std::string> names;
  if (!run.result->IsUsable()) return names;
  for (const EnergySpec& spec : run.settings->options.extra_energies) {
    for (const TermEnergy& term : run.result->final_energy.terms) {
      if (term.label == spec.name && term.residuals == 0) names.push_back(spec.name);
    }
  }
  return names;
}

}  // namespace

std::vector<std::string> FitWarnings(const FitRun& run) {
  std::vector<std::string> warnings = run.files->warnings;
  // A fit copes with what is only noted, and says itself what it did.
  for (const Finding& finding : run.files->checks) {
    const bool is_known =
        finding.code == "units" && run.result->warp.target_from_source.scale != 1.0;
    if (finding.severity == Severity::kWarning && !is_known) {
      warnings.push_back(finding.text + "; " + finding.fix);
    }
  }
  warnings.insert(warnings.end(), run.result->warnings.begin(), run.result->warnings.end());
  const FitOptions& options = run.settings->options;
  const auto add = [&warnings](const std::vector<std::string>& more) {
    warnings.insert(warnings.end(), more.begin(), more.end());
  };
  add(IdlePluginWarnings(*run.registry, options.extra_energies));
  add(IdleEnergyWarnings(*run.registry, IdleEnergies(run)));
  BackendUse use;
  use.ceres = options.strategy.linear_solver == LinearSolver::kCeres;
  for (const std::string& warning : BackendWarnings(DescribeBackend(), use)) {
    warnings.push_back(warning);
  }
  return warnings;
}

ordered_json FitReport(const FitRun& run) {
  const FitResult& result = *run.result;
  return {
      {"program", "ed_fit"},
      {"version", kVersion},
      {"mode", NameOf(run.settings->options.strategy.mode)},
      {"status", NameOf(result.status)},
      {"message", result.message},
      {"source", CloudReport(run.files->source)},
      {"target", CloudReport(run.files->target)},
      {"nodes", NodesReport(result)},
      {"active_set", ActiveSetReport(run.settings->options.strategy, result)},
      {"inliers", result.matches.inliers},
      {"outer_iterations", result.outer_iterations},
      {"solver_iterations", result.solver_iterations},
      {"energy", EnergyReport(result)},
      {"rms",
       {{"point_to_plane", result.matches.rms_plane},
        {"point_to_point", result.matches.rms_point}}},
      {"noise", result.noise},
      {"landmarks", LandmarksReport(run)},
      {"fixed", {{"count", run.files->input.fixed_points.size()}, {"max", result.max_fixed_error}}},
      {"rigid", RigidReport(result.rigid)},
      {"hypothesis", result.hypothesis},
      {"checks", ChecksReport(run.files->checks)},
      {"verdict", VerdictReport(run.verdict)},
      {"unmatched", UnmatchedReport(result.evidence)},
      {"evidence", EvidenceReport(result.evidence)},
      {"covariance", CovarianceReport(result.uncertainty)},
      {"displacement", DisplacementReport(run)},
      {"time_s", TimeReport(run)},
      {"threads", run.settings->options.num_threads},
      {"warnings", run.warnings},
      {"flags", FlagsReport(run.settings->flags)},
      {"flags_given", GivenFlagsReport(run.settings->flags)},
      {"command",
       CommandText("ed_fit", {run.settings->source, run.settings->target}, run.settings->flags)},
      {"backend", BackendReport()}};
}

ordered_json FitResultReport(const FitResult& result, const Verdict& verdict) {
  return {{"status", NameOf(result.status)},
          {"message", result.message},
          {"nodes", NodesReport(result)},
          {"inliers", result.matches.inliers},
          {"energy", EnergyReport(result)},
          {"verdict", VerdictReport(verdict)},
          {"unmatched", UnmatchedReport(result.evidence)},
          {"evidence", EvidenceReport(result.evidence)},
          {"covariance", CovarianceReport(result.uncertainty)},
          {"time_s", StagesReport(result.times)},
          {"warnings", result.warnings}};
}

}  // namespace ceres_ed
