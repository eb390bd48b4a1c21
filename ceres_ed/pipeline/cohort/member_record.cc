#include "ceres_ed/pipeline/cohort/member_record.h"

#include <ceres_ed/io/json_file.h>

#include <cmath>

namespace ceres_ed {
namespace {

using nlohmann::ordered_json;

ordered_json NumberOrNull(double number) {
  return std::isfinite(number) ? ordered_json(number) : ordered_json(nullptr);
}

double NumberOf(const nlohmann::json& json, const char* name) {
  const auto at = json.find(name);
  const bool is_number = at != json.end() && at->is_number();
  return is_number ? at->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::string TextOf(const nlohmann::json& json, const char* name) {
  const auto at = json.find(name);
  return at != json.end() && at->is_string() ? at->get<std::string>() : "";
}

}  // namespace

std::string MemberRecord::Verdict() const {
  return state == MemberState::kDone ? NameOf(grade) : NameOf(state);
}

ordered_json RecordReport(const MemberRecord& record) {
  return {{"name", record.name},
          {"key", record.key},
          {"shared_key", record.shared_key},
          {"state", NameOf(record.state)},
          {"verdict", NameOf(record.grade)},
          {"unmatched",
           {{"source", NumberOrNull(record.unmatched_source)},
            {"target", NumberOrNull(record.unmatched_target)}}},
          {"landmarks", {{"count", record.landmarks}, {"rms", NumberOrNull(record.landmark_rms)}}},
          {"stretch", NumberOrNull(record.stretch)},
          {"seconds", record.seconds},
          {"message", record.message}};
}

StatusOr<MemberRecord> ReadRecord(const std::string& path) {
  const StatusOr<nlohmann::json> json = ReadJsonFile(path);
  if (!json.ok()) return json.status();
  MemberRecord record;
  const nlohmann::json nothing = nlohmann::json::object();
  const auto object = [&](const char* name) {
    return json->is_object() && json->contains(name) && (*json)[name].is_object() ? (*json)[name]
                                                                                  : nothing;
  };
  const nlohmann::json& all = json->is_object() ? *json : nothing;
  record.name = TextOf(all, "name");
  record.key = TextOf(all, "key");
  record.shared_key = TextOf(all, "shared_key");
  const auto state = FindByName<MemberState>(TextOf(all, "state"));
  const auto grade = FindByName<Grade>(TextOf(all, "verdict"));
  if (record.name.empty() || !state || !grade) {
    return Status::Error(path + ": no record of a member of a cohort");
  }
  record.state = *state;
  record.grade = *grade;
  record.unmatched_source = NumberOf(object("unmatched"), "source");
  record.unmatched_target = NumberOf(object("unmatched"), "target");
  const double count = NumberOf(object("landmarks"), "count");
  record.landmarks = count >= 0.0 && count < 1e6 ? static_cast<int>(count) : 0;
  record.landmark_rms = NumberOf(object("landmarks"), "rms");
  record.stretch = NumberOf(all, "stretch");
  record.seconds = NumberOf(all, "seconds");
  record.message = TextOf(all, "message");
  return record;
}

}  // namespace ceres_ed
