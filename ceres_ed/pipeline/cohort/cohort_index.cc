#include "ceres_ed/pipeline/cohort/cohort_index.h"

#include <ceres_ed/io/json_file.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/pipeline/report.h>
#include <ceres_ed/version.h>

#include <algorithm>
#include <set>
#include <utility>

namespace ceres_ed {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

std::string IndexPath(const std::string& folder) { return folder + "/cohort.json"; }

std::string TextOf(const json& object, const char* name) {
  const auto at = object.find(name);
  return at != object.end() && at->is_string() ? at->get<std::string>() : "";
}

Status Bad(const std::string& path, const std::string& why) {
  return Status::Error(path + ": " + why + ", expected the file of ed_cohort");
}

}  // namespace

Status WriteCohortIndex(const std::string& output, const CohortIndex& index) {
  ordered_json members = ordered_json::array();
  for (const CohortMember& member : index.members) {
    members.push_back({{"name", member.name}, {"path", member.path}, {"group", member.group}});
  }
  return WriteReport(IndexPath(output),
                     {{"program", "ed_cohort"},
                      {"version", kVersion},
                      {"kind", NameOf(index.kind)},
                      {"template", index.source},
                      {"shared_key", index.shared_key},
                      {"rounds", index.rounds},
                      {"members", std::move(members)}});
}

StatusOr<CohortIndex> ReadCohortIndex(const std::string& folder) {
  const std::string path = IndexPath(folder);
  const StatusOr<json> read = ReadJsonFile(path);
  if (!read.ok()) return read.status();
  if (!read->is_object()) return Bad(path, "is no object");
  CohortIndex index;
  const auto kind = FindByName<CohortKind>(TextOf(*read, "kind"));
  if (!kind) return Bad(path, "'kind' is " + Quoted(TextOf(*read, "kind")));
  index.kind = *kind;
  index.source = TextOf(*read, "template");
  index.shared_key = TextOf(*read, "shared_key");
  if (read->contains("rounds") && (*read)["rounds"].is_array()) index.rounds = (*read)["rounds"];
  const auto members = read->find("members");
  if (members == read->end() || !members->is_array())
    return Bad(path, "there is no list 'members'");
  std::set<std::string> names;
  for (const json& entry : *members) {
    CohortMember member;
    if (entry.is_object()) {
      member.name = TextOf(entry, "name");
      member.path = TextOf(entry, "path");
      member.group = TextOf(entry, "group");
    }
    member.row = static_cast<int>(index.members.size());
    if (Status status = CheckMemberName(member.name); !status.ok()) {
      return Status::Error(path + ": member " + std::to_string(member.row + 1) + ": " +
                           status.message());
    }
    if (!names.insert(member.name).second) {
      return Bad(path, "the name " + Quoted(member.name) + " occurs twice");
    }
    index.members.push_back(std::move(member));
  }
  return index;
}

}  // namespace ceres_ed
