#include "ceres_ed/pipeline/cohort/member_run.h"

#include <ceres_ed/io/json_file.h>
#include <ceres_ed/pipeline/cohort/content_key.h>
#include <ceres_ed/pipeline/cohort/member_fit.h>
#include <ceres_ed/pipeline/cohort/member_folder.h>
#include <ceres_ed/pipeline/cohort/member_sequence.h>
#include <ceres_ed/pipeline/report.h>
#include <ceres_ed/util/text.h>
#include <ceres_ed/util/timer.h>
#include <ceres_ed/version.h>

#include <exception>
#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>
#include <utility>

namespace ceres_ed {
namespace {

// Returns the ContentKey of a member.
std::string KeyOf(const CohortContext& context, const CohortMember& member) {
  ContentKey key;
  key.AddText(context.shared_key);
  for (const std::string* file :
       {&member.path, &member.landmarks, &member.source, &member.source_landmarks}) {
    key.AddText(file->empty() ? "none" : "file");
    if (!file->empty()) key.AddFile(*file);
  }
  key.AddText(member.unit);
  return key.Text();
}

// Returns whether a record of these inputs is there; reads it.
bool IsDone(const CohortSettings& settings,
            const CohortMember& member,
            const std::string& key,
            MemberRecord* record) {
  if (!settings.resume) return false;
  const std::string path = MemberPath(settings.output, member.name) + "/record.json";
  StatusOr<MemberRecord> read = ReadRecord(path);
  if (!read.ok() || read->key != key) return false;
  if (read->state == MemberState::kFailed && settings.retry_failed) return false;
  *record = *std::move(read);
  return true;
}

// Fits or tracks; what is thrown becomes the message of a run that has failed.
MemberRun::End RunInFolder(const CohortContext& context,
                           const CohortMember& member,
                           const MemberFolder& folder,
                           const std::function<bool()>& should_stop,
                           MemberRecord* record) {
  const Timer clock;
  Outcome outcome;
  try {
    outcome = context.kind == CohortKind::kSequences
                  ? TrackMember(context, member, folder, should_stop, record)
                  : FitMember(context, member, folder, should_stop, record);
  } catch (const std::bad_alloc&) {
    outcome = Outcome::NoResult(Status::Error("there is not enough memory"));
  } catch (const std::exception& error) {
    outcome = Outcome::NoResult(Status::Error(error.what()));
  }
  record->seconds = clock.Seconds();
  if (should_stop()) return MemberRun::End::kStopped;
  const bool is_usable = outcome.done() || outcome.code == ExitCode::kStoppedEarly;
  record->state = is_usable ? MemberState::kDone : MemberState::kFailed;
  if (!outcome.done()) record->message = outcome.message;
  return MemberRun::End::kRun;
}

std::size_t SizeOf(const std::string& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  return error ? 0 : static_cast<std::size_t>(size);
}

}  // namespace

std::string SharedKey(const CohortSettings& settings, CohortKind kind) {
  ContentKey key;
  key.AddText(kVersion);
  key.AddText(NameOf(kind));
  for (const RunFlag& flag : settings.fit.flags) key.AddText(flag.name + "=" + flag.value);
  for (const std::string* file :
       {&settings.source, &settings.fit.source_landmarks, &settings.fit.fixed}) {
    key.AddText(file->empty() ? "none" : "file");
    if (!file->empty()) key.AddFile(*file);
  }
  for (const std::string_view plugin : SplitFields(settings.fit.plugin, ';')) {
    if (!Trim(plugin).empty()) key.AddFile(std::string(Trim(plugin)));
  }
  key.AddText(settings.unit);
  return key.Text();
}

MemberRun RunMember(const CohortContext& context,
                    const CohortMember& member,
                    const std::function<bool()>& should_stop) {
  MemberRun run;
  const CohortSettings& settings = *context.settings;
  const std::string key = KeyOf(context, member);
  if (IsDone(settings, member, key, &run.record)) {
    run.end = MemberRun::End::kSkipped;
    return run;
  }
  const auto not_written = [&run](const Status& status) {
    run.end = MemberRun::End::kNotWritten;
    run.error = status.message();
    return run;
  };
  StatusOr<MemberFolder> folder = MemberFolder::Create(settings.output, member.name);
  if (!folder.ok()) return not_written(folder.status());
  run.record.name = member.name;
  run.record.key = key;
  run.record.shared_key = context.shared_key;
  run.end = RunInFolder(context, member, *folder, should_stop, &run.record);
  if (run.end == MemberRun::End::kStopped) return run;
  Status status = WriteReport(folder->File("record.json"), RecordReport(run.record));
  if (status.ok()) status = folder->Commit();
  return status.ok() ? run : not_written(status);
}

std::size_t EstimateMemory(const CohortContext& context, const CohortMember& member) {
  // A fit keeps both surfaces with their search structures, the graphs, and the page that shows
  // them. A binary file has about 20 bytes for each vertex with its share of the faces.
  constexpr std::size_t kBase = std::size_t{24} << 20;
  constexpr std::size_t kPerPoint = 3000;
  constexpr std::size_t kBytesOfFilePerPoint = 36;
  if (context.kind == CohortKind::kSequences) return std::size_t{512} << 20;
  const std::size_t source = context.source != nullptr
                                 ? context.source->loaded.cloud.size()
                                 : SizeOf(member.source) / kBytesOfFilePerPoint;
  const std::size_t target = SizeOf(member.path) / kBytesOfFilePerPoint;
  return kBase + kPerPoint * (source + target);
}

}  // namespace ceres_ed
