#include "ceres_ed/report/html/report_json.h"

#include <ceres_ed/report/view/number_text.h>

#include <limits>

namespace ceres_ed {

using nlohmann::ordered_json;

const ordered_json& MemberOf(const ordered_json& report, ReportPath path) {
  static const ordered_json null;
  const ordered_json* at = &report;
  for (const char* const name : path) {
    if (!at->is_object()) return null;
    const auto found = at->find(name);
    if (found == at->end()) return null;
    at = &*found;
  }
  return *at;
}

double NumberOf(const ordered_json& report, ReportPath path) {
  const ordered_json& member = MemberOf(report, path);
  return member.is_number() ? member.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::string TextOf(const ordered_json& report, ReportPath path) {
  const ordered_json& member = MemberOf(report, path);
  return member.is_string() ? member.get<std::string>() : std::string();
}

std::string FlagText(const ordered_json& value) {
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  return value.is_number() ? value.dump() : ValueText(value);
}

std::string ValueText(const ordered_json& value, int digits) {
  if (value.is_null()) return "-";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_integer()) return value.dump();
  if (value.is_number()) return ShortNumber(value.get<double>(), digits);
  return "(...)";
}

}  // namespace ceres_ed
