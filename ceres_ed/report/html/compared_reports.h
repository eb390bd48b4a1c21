// What the pages of several runs have in common.
#ifndef CERES_ED_REPORT_HTML_COMPARED_REPORTS_H_
#define CERES_ED_REPORT_HTML_COMPARED_REPORTS_H_

#include <ceres_ed/report/html/page.h>

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Adds the flags that have not the same value in all reports, each of which has a name.
void AddFlagsThatDiffer(
    const std::vector<std::pair<std::string, const nlohmann::ordered_json*>>& reports,
    HtmlPage* page);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_COMPARED_REPORTS_H_
