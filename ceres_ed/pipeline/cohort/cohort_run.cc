#include "ceres_ed/pipeline/cohort/cohort_run.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/landmarks/landmark_file.h>
#include <ceres_ed/pipeline/cohort/cohort_checks.h>
#include <ceres_ed/pipeline/cohort/cohort_summary.h>
#include <ceres_ed/pipeline/cohort/member_run.h>
#include <ceres_ed/pipeline/cohort/member_runs.h>
#include <ceres_ed/pipeline/energies.h>
#include <ceres_ed/pipeline/fit/carried_points.h>
#include <ceres_ed/pipeline/outputs.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

namespace ceres_ed {
namespace {

// One round: a template, and the members that it is fitted to.
class Round {
 public:
  Round(const CohortSettings& settings, const Manifest& manifest)
      : settings_(settings), manifest_(manifest) {}

  // Reads the template and writes what the folder of a cohort begins with.
  Outcome Prepare();
  // Runs the members.
  Outcome Run(const Timer& clock, CohortObserver* observer);

  const FitSource& source() const { return *source_; }
  CohortIndex index;

 private:
  const CohortSettings& settings_;
  const Manifest& manifest_;
  EnergyRegistry registry_;
  std::optional<FitSource> source_;
  std::unique_ptr<SurfaceFitter> fitter_;
};

Outcome Round::Prepare() {
  Outcome energies =
      LoadEnergies(settings_.fit.plugin, settings_.fit.options.extra_energies, &registry_);
  if (!energies.done()) return energies;
  index.kind = manifest_.kind;
  index.source = settings_.source;
  index.members = manifest_.members;
  index.shared_key = SharedKey(settings_, manifest_.kind);
  if (manifest_.kind == CohortKind::kShapes) {
    FitSettings fit = settings_.fit;
    fit.source = settings_.source;
    fit.options.num_threads = 1;
    StatusOr<FitSource> source = LoadFitSource(fit);
    if (!source.ok()) return Outcome::BadInput(source.status());
    source_ = *std::move(source);
    auto fitter = SurfaceFitter::Create(source_->loaded.cloud, fit.options, registry_);
    if (!fitter.ok()) {
      return Outcome::BadInput(Status::Error(settings_.source + ": " + fitter.status().message()));
    }
    fitter_ = *std::move(fitter);
  }
  RemoveAbandonedFiles(settings_.output);
  Status status = PrepareOutput(settings_.output + "/cohort.json");
  if (status.ok() && source_.has_value()) {
    CloudWriteOptions options;
    options.double_precision = true;
    PointCloud cloud;
    cloud.points = source_->loaded.cloud.points;
    cloud.triangles = source_->loaded.cloud.triangles;
    status = WriteCloud(settings_.output + "/template.ply", cloud, options);
  }
  if (status.ok()) status = WriteCohortIndex(settings_.output, index);
  return status.ok() ? Outcome::Done() : Outcome::BadInput(status);
}

Outcome Round::Run(const Timer& clock, CohortObserver* observer) {
  const CohortContext context = {&settings_,
                                 manifest_.kind,
                                 &registry_,
                                 source_.has_value() ? &*source_ : nullptr,
                                 fitter_.get(),
                                 index.shared_key};
  return RunMembers(context, manifest_.members, clock, observer);
}

bool Fails(const MemberRecord& record, FailIf fail_if) {
  if (record.state != MemberState::kDone) return true;
  return (fail_if == FailIf::kDoubtful && record.grade != Grade::kGood) ||
         (fail_if == FailIf::kBad && record.grade == Grade::kBad);
}

// Collects the members of `settings.folders` into `output`; see CollectCohort().
Outcome Collect(const CollectSettings& settings,
                const std::string& output,
                CohortObserver* observer,
                ShapeStatistics* statistics) {
  StatusOr<CollectedMembers> all = ReadMembers(settings.folders);
  if (!all.ok()) return Outcome::BadInput(all.status());
  RemoveAbandonedFiles(output);
  if (Status status = PrepareOutput(output + "/summary.csv"); !status.ok()) {
    return Outcome::BadInput(status);
  }
  if (all->index.kind == CohortKind::kShapes) {
    const StatusOr<PointCloud> source = ReadCohortTemplate(settings.folders.front());
    if (!source.ok()) return Outcome::BadInput(source.status());
    auto computed = ComputeShapeStatistics(output, settings.model, *source, &*all);
    if (!computed.ok()) return Outcome::BadInput(computed.status());
    *statistics = *std::move(computed);
    for (const std::string& note : statistics->notes) observer->OnWarning(note);
  }
  if (Status status = WriteSummary(output, *all, *statistics); !status.ok()) {
    return Outcome::BadInput(status);
  }
  observer->OnCollected(*all, *statistics);
  int failed = 0;
  for (const CollectedMember& member : all->members) {
    failed += Fails(member.record, settings.fail_if) ? 1 : 0;
  }
  if (failed == 0) return Outcome::Done();
  return Outcome::NoResult(Status::Error(
      output + ": " + std::to_string(failed) + " of " +
      MemberCount(static_cast<int>(all->members.size())) +
      (settings.fail_if == FailIf::kNever ? " have no result; see summary.csv"
                                          : " have no result, or a verdict that is not accepted; "
                                            "see summary.csv")));
}

// Writes the landmarks of the template where the mean has them.
Status WriteMeanLandmarks(const CohortSettings& settings,
                          const FitSource& source,
                          const PointCloud& mean,
                          const std::string& path) {
  StatusOr<LandmarkFile> file = ReadLandmarkFile(settings.fit.source_landmarks);
  if (!file.ok()) return file.status();
  const AnatomicalSpace space = SpaceOfMesh(settings.fit.mesh_space, source.loaded.document);
  std::vector<Eigen::Vector3d> positions;
  for (const NamedLandmark& point : file->points) {
    positions.push_back(BetweenSpaces(point.position, file->space, space));
  }
  positions = CarryPoints(source.loaded.cloud, mean.points, Similarity(), positions);
  for (Eigen::Vector3d& position : positions) {
    position = BetweenSpaces(position, space, file->space);
  }
  return WriteLandmarkFile(path, *file, positions);
}

CohortKind KindOf(const CohortSettings& settings) {
  if (!settings.pairs.empty()) return CohortKind::kPairs;
  return settings.sequences.empty() ? CohortKind::kShapes : CohortKind::kSequences;
}

// Runs the rounds in which the mean becomes the template. `settings` gets the template of the last
// round, and `rounds` what changed in each.
Outcome Iterate(const Manifest& manifest,
                const Timer& clock,
                CohortObserver* observer,
                CohortSettings* settings,
                nlohmann::ordered_json* rounds) {
  const std::string output = settings->output;
  const int count = settings->iterate;
  for (int number = 1; number <= count; ++number) {
    settings->output = output + "/rounds/" + std::to_string(number);
    Round round(*settings, manifest);
    Outcome outcome = round.Prepare();
    if (outcome.done()) outcome = round.Run(clock, observer);
    if (!outcome.done() && outcome.code != ExitCode::kNoResult) return outcome;
    ShapeStatistics statistics;
    CollectSettings collect;
    collect.folders = {settings->output};
    collect.model = settings->model;
    outcome = Collect(collect, settings->output, observer, &statistics);
    if (statistics.mean.empty()) {
      return outcome.done() || outcome.code == ExitCode::kNoResult
                 ? Outcome::NoResult(
                       Status::Error(settings->output + ": no shape is good enough for a mean"))
                 : outcome;
    }
    rounds->push_back({{"round", number}, {"change", statistics.change}});
    if (!settings->fit.source_landmarks.empty()) {
      const std::string ending =
          std::filesystem::path(settings->fit.source_landmarks).extension().string();
      const std::string landmarks = settings->output + "/mean_landmarks" + ending;
      Status status = WriteMeanLandmarks(*settings, round.source(), statistics.mean, landmarks);
      if (!status.ok()) return Outcome::BadInput(status);
      settings->fit.source_landmarks = landmarks;
    }
    settings->source = settings->output + "/mean.ply";
    settings->output = output;
  }
  return Outcome::Done();
}

}  // namespace

Outcome RunCohort(const CohortSettings& given, const Timer& clock, CohortObserver* observer) {
  if (Status status = CheckCohort(given); !status.ok()) return Outcome::Usage(status.message());
  const CohortKind kind = KindOf(given);
  const std::string& table = kind == CohortKind::kPairs       ? given.pairs
                             : kind == CohortKind::kSequences ? given.sequences
                                                              : given.manifest;
  const StatusOr<Manifest> manifest =
      ReadManifest(table, kind, !given.fit.source_landmarks.empty());
  if (!manifest.ok()) return Outcome::BadInput(manifest.status());
  for (const std::string& note : manifest->notes) observer->OnNote(note);
  if (Status status = CheckMembers(given, table, *manifest); !status.ok()) {
    return Outcome::BadInput(status);
  }
  CohortSettings settings = given;
  nlohmann::ordered_json rounds = nlohmann::ordered_json::array();
  Outcome outcome = Iterate(*manifest, clock, observer, &settings, &rounds);
  if (!outcome.done()) return outcome;
  Round last(settings, *manifest);
  last.index.rounds = rounds;
  outcome = last.Prepare();
  if (!outcome.done()) return outcome;
  outcome = last.Run(clock, observer);
  if (!settings.shard.IsWhole()) return outcome;
  if (!outcome.done() && outcome.code != ExitCode::kNoResult) return outcome;
  CollectSettings collect;
  collect.folders = {settings.output};
  collect.model = settings.model;
  collect.fail_if = settings.fit.fail_if;
  return CollectCohort(collect, observer);
}

Outcome CollectCohort(const CollectSettings& settings, CohortObserver* observer) {
  if (settings.folders.empty()) return Outcome::Usage("no folder is given, expected one or more");
  ShapeStatistics statistics;
  const std::string& output = settings.output.empty() ? settings.folders.front() : settings.output;
  return Collect(settings, output, observer, &statistics);
}

}  // namespace ceres_ed
