#include "ceres_ed/pipeline/cohort/cohort_summary.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/report/html/cohort_page.h>
#include <ceres_ed/util/options.h>

#include <cmath>
#include <filesystem>
#include <system_error>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

// Returns a text as one field of a table.
std::string CsvField(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c == '\n' || c == '\r' ? ' ' : c;
  }
  return quoted + "\"";
}

std::string NumberField(double value) { return std::isfinite(value) ? NumberText(value) : ""; }

std::string SecondsField(double seconds) {
  return std::isfinite(seconds) ? NumberText(std::round(seconds * 1000.0) / 1000.0) : "";
}

// Returns the path of a file in the folder of a member, seen from `output`; empty if there is no
// such file.
std::string LinkTo(const std::string& output, const CollectedMember& member, const char* file) {
  std::error_code error;
  if (member.folder.empty()) return "";
  const fs::path path = fs::path(member.folder) / file;
  if (!fs::exists(path, error)) return "";
  const fs::path relative = fs::absolute(path, error)
                                .lexically_normal()
                                .lexically_relative(fs::absolute(output, error).lexically_normal());
  return relative.empty() ? path.string() : relative.string();
}

std::string Table(const CollectedMembers& all, const std::vector<int>& order) {
  std::string table =
      "name,group,verdict,unmatched_source,unmatched_target,landmarks,landmark_rms,stretch,"
      "in_model,message,seconds\n";
  for (const int number : order) {
    const CollectedMember& member = all.members[number];
    const MemberRecord& record = member.record;
    const bool is_done = record.state == MemberState::kDone;
    for (const std::string& field : {CsvField(member.member.name),
                                     CsvField(member.member.group),
                                     record.Verdict(),
                                     NumberField(record.unmatched_source),
                                     NumberField(record.unmatched_target),
                                     is_done ? std::to_string(record.landmarks) : "",
                                     NumberField(record.landmark_rms),
                                     NumberField(record.stretch),
                                     std::string(member.in_model ? "1" : "0"),
                                     CsvField(record.message)}) {
      table += field + ",";
    }
    const bool was_run = record.state != MemberState::kMissing;
    table += (was_run ? SecondsField(record.seconds) : "") + "\n";
  }
  return table;
}

CohortPageRow PageRow(const std::string& output, const CollectedMember& member) {
  const MemberRecord& record = member.record;
  CohortPageRow row;
  row.name = member.member.name;
  row.group = member.member.group;
  row.verdict = record.Verdict();
  row.message = record.message;
  row.unmatched = std::fmax(record.unmatched_source, record.unmatched_target);
  row.landmark_rms = record.landmark_rms;
  row.stretch = record.stretch;
  row.seconds = record.seconds;
  row.in_model = member.in_model;
  row.report = LinkTo(output, member, "report.html");
  if (row.report.empty()) row.report = LinkTo(output, member, "tracked/report.json");
  if (row.report.empty()) row.report = LinkTo(output, member, "report.json");
  row.thumbnail = LinkTo(output, member, "thumbnail.png");
  return row;
}

}  // namespace

Status WriteSummary(const std::string& output,
                    const CollectedMembers& all,
                    const ShapeStatistics& statistics) {
  const std::vector<int> order = WorstFirst(all.members);
  Status status = WriteFileAtomically(output + "/summary.csv", Table(all, order));
  if (!status.ok()) return status;
  CohortPageContent content;
  content.kind = NameOf(all.index.kind);
  content.source = all.index.source;
  content.statistics = statistics.report;
  for (const int number : order) content.rows.push_back(PageRow(output, all.members[number]));
  return WriteFileAtomically(output + "/summary.html", CohortPage(content));
}

}  // namespace ceres_ed
