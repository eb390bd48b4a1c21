// Sections that the pages of all runs have.
#ifndef CERES_ED_REPORT_HTML_RUN_SECTIONS_H_
#define CERES_ED_REPORT_HTML_RUN_SECTIONS_H_

#include <ceres_ed/report/html/page.h>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Each adds what `report` (report.json of a run) has of its subject, and nothing if it has nothing.
// The verdict with its reasons and advice, and the warnings.
void AddVerdict(const nlohmann::ordered_json& report, HtmlPage* page);
// The time of each stage of a fit, and of each stage of the frames of a sequence.
void AddTimes(const nlohmann::ordered_json& report, HtmlPage* page);
void AddFrameTimes(const nlohmann::ordered_json& report, HtmlPage* page);
// What the checks of the inputs have found.
void AddChecks(const nlohmann::ordered_json& report, HtmlPage* page);
// The command that repeats the run, and all flags.
void AddFlags(const nlohmann::ordered_json& report, HtmlPage* page);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_RUN_SECTIONS_H_
