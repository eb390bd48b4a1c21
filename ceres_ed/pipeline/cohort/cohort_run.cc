#include "ceres_ed/pipeline/cohort/cohort_run.h"

#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/landmarks/landmark_file.h>
#include <ceres_ed/pipeline/cohort/cohort_summary.h>
#include <ceres_ed/pipeline/cohort/job_pool.h>
#include <ceres_ed/pipeline/cohort/member_folder.h>
#include <ceres_ed/pipeline/cohort/member_run.h>
#include <ceres_ed/pipeline/energies.h>
#include <ceres_ed/pipeline/fit/carried_points.h>
#include <ceres_ed/pipeline/outputs.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace ceres_ed {
namespace {

// Returns "3 min", "40 s" or "2.5 h".
std::string DurationText(double seconds) {
  if (seconds < 100.0) return std::to_string(std::lround(seconds)) + " s";
  if (seconds < 6000.0) return std::to_string(std::lround(seconds / 60.0)) + " min";
  return std::to_string(std::lround(seconds / 360.0) / 10) + "." +
         std::to_string(std::lround(seconds / 360.0) % 10) + " h";
}

std::string Plural(int count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

// The runs of all members of a shard.
class MemberRuns {
 public:
  MemberRuns(const CohortContext& context, const Timer& clock, CohortObserver* observer)
      : context_(context), clock_(clock), observer_(*observer) {}

  // Returns how it ended.
  Outcome Run(const std::vector<CohortMember>& members);

 private:
  // Takes the results since the last call, and shows the progress. Returns false if the run must
  // end.
  bool Watch(int ended);
  void Take(const MemberRun& run);
  std::string ProgressNote(int ended) const;

  const CohortContext& context_;
  const Timer& clock_;
  CohortObserver& observer_;
  int total_ = 0;
  int done_ = 0;
  int skipped_ = 0;
  int failed_ = 0;
  // The first error of results that could not be written.
  std::string not_written_;
  std::atomic<bool> must_stop_{false};
  std::mutex mutex_;
  // Results that have not been taken.
  std::vector<MemberRun> fresh_;
};

void MemberRuns::Take(const MemberRun& run) {
  switch (run.end) {
    case MemberRun::End::kRun:
      ++done_;
      break;
    case MemberRun::End::kSkipped:
      ++skipped_;
      break;
    case MemberRun::End::kNotWritten:
      if (not_written_.empty()) not_written_ = run.error;
      return;
    case MemberRun::End::kStopped:
      return;
  }
  if (run.record.state != MemberState::kFailed) return;
  ++failed_;
  observer_.OnWarning(run.record.name + ": " + run.record.message);
}

std::string MemberRuns::ProgressNote(int ended) const {
  std::string note = std::to_string(ended) + " of " + std::to_string(total_);
  if (failed_ > 0) note += ", " + std::to_string(failed_) + " failed";
  // What was skipped took no time, and tells nothing about what is left.
  const int run = done_;
  if (run > 0 && ended < total_) {
    note += ", " + DurationText(clock_.Seconds() / run * (total_ - ended)) + " left";
  }
  return note;
}

bool MemberRuns::Watch(int ended) {
  std::vector<MemberRun> fresh;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    fresh.swap(fresh_);
  }
  for (const MemberRun& run : fresh) Take(run);
  observer_.OnProgress(ended, std::max(1, total_), ProgressNote(ended));
  if (observer_.ShouldStop() || !not_written_.empty()) must_stop_ = true;
  return !must_stop_;
}

Outcome MemberRuns::Run(const std::vector<CohortMember>& members) {
  const CohortSettings& settings = *context_.settings;
  std::vector<const CohortMember*> mine;
  for (const CohortMember& member : members) {
    if (settings.shard.Contains(member.row)) mine.push_back(&member);
  }
  // A member whose run ended with its process may have been the reason, and comes last.
  const std::set<std::string> abandoned = RemoveAbandonedWork(settings.output);
  std::stable_partition(mine.begin(), mine.end(), [&abandoned](const CohortMember* member) {
    return abandoned.count(member->name) == 0;
  });
  total_ = static_cast<int>(mine.size());
  std::vector<std::size_t> needs;
  needs.reserve(mine.size());
  for (const CohortMember* member : mine) needs.push_back(EstimateMemory(context_, *member));
  JobPoolOptions options;
  options.threads = settings.jobs > 0
                        ? settings.jobs
                        : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  options.memory = static_cast<std::size_t>(settings.memory_mb) << 20;
  const std::function<bool()> should_stop = [this] { return must_stop_.load(); };
  RunJobs(
      needs,
      options,
      [&](int job) {
        MemberRun run = RunMember(context_, *mine[job], should_stop);
        const std::lock_guard<std::mutex> lock(mutex_);
        fresh_.push_back(std::move(run));
      },
      [this](int ended) { return Watch(ended); });
  if (!not_written_.empty()) return Outcome::BadInput(Status::Error(not_written_));
  if (done_ + skipped_ < total_) {
    return Outcome::StoppedEarly("stopped with " + std::to_string(done_ + skipped_) + " of " +
                                 Plural(total_, "member") + " in " + settings.output +
                                 "; the same command goes on from there");
  }
  observer_.OnShard(done_, skipped_, failed_);
  if (failed_ == 0) return Outcome::Done();
  return Outcome::NoResult(Status::Error(settings.output + ": " + std::to_string(failed_) + " of " +
                                         Plural(total_, "member") + " failed"));
}

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
  return MemberRuns(context, clock, observer).Run(manifest_.members);
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
      Plural(static_cast<int>(all->members.size()), "member") +
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

// Checks what does not depend on files.
Status CheckCohort(const CohortSettings& settings) {
  const int inputs = (settings.manifest.empty() ? 0 : 1) + (settings.pairs.empty() ? 0 : 1) +
                     (settings.sequences.empty() ? 0 : 1);
  if (inputs != 1) {
    return Status::Error("--manifest, --pairs and --sequences: " + std::to_string(inputs) +
                         " of them are given, expected one");
  }
  const bool is_of_shapes = !settings.manifest.empty();
  if (is_of_shapes != !settings.source.empty()) {
    return Status::Error(is_of_shapes ? "no TEMPLATE is given, expected one for --manifest"
                                      : "TEMPLATE is '" + settings.source +
                                            "', expected none with --pairs or --sequences");
  }
  if (settings.iterate > 0 && !is_of_shapes) {
    return Status::Error("--iterate=" + std::to_string(settings.iterate) +
                         ", expected 0 with --pairs or --sequences");
  }
  if (settings.iterate > 0 && !settings.shard.IsWhole()) {
    return Status::Error("--iterate=" + std::to_string(settings.iterate) +
                         " with --shard, expected one of them: the mean needs all shapes");
  }
  return Status::Ok();
}

// Checks what the manifest and the settings say about landmarks and units.
Status CheckMembers(const CohortSettings& settings, const Manifest& manifest) {
  for (const CohortMember& member : manifest.members) {
    const std::string place =
        settings.manifest + ": row " + std::to_string(member.row + 1) + ", " + member.name + ": ";
    if (manifest.kind == CohortKind::kShapes && !member.landmarks.empty() &&
        settings.fit.source_landmarks.empty()) {
      return Status::Error(place +
                           "has landmarks, expected --source_landmarks with those of TEMPLATE");
    }
    if (!member.unit.empty() && settings.unit.empty()) {
      return Status::Error(place + "has the unit " + member.unit +
                           ", expected --unit with that of TEMPLATE");
    }
  }
  return Status::Ok();
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
  if (Status status = CheckMembers(given, *manifest); !status.ok()) {
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
