// Reads report.json of a run. The file may come from anywhere, so a member may be missing or have
// another type than it should.
#ifndef CERES_ED_REPORT_HTML_REPORT_JSON_H_
#define CERES_ED_REPORT_HTML_REPORT_JSON_H_

#include <initializer_list>
#include <string>

#include <nlohmann/json.hpp>

namespace ceres_ed {

using ReportPath = std::initializer_list<const char*>;

// Returns the member at a path of names; null if one of them is missing.
const nlohmann::ordered_json& MemberOf(const nlohmann::ordered_json& report, ReportPath path);

// Returns a number; NaN if there is none.
double NumberOf(const nlohmann::ordered_json& report, ReportPath path);

// Returns a text; empty if there is none.
std::string TextOf(const nlohmann::ordered_json& report, ReportPath path);

// Returns the value of a flag: a number with the fewest digits from which the same number is read.
std::string FlagText(const nlohmann::ordered_json& value);

// Returns any value as people read it: texts as they are, numbers with `digits` digits, yes or no,
// "-" for null, and "(...)" for lists and objects.
std::string ValueText(const nlohmann::ordered_json& value, int digits = 4);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_REPORT_JSON_H_
