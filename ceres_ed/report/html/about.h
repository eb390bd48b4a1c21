// The last section of a page: what made it, and the licences of what is in it.
#ifndef CERES_ED_REPORT_HTML_ABOUT_H_
#define CERES_ED_REPORT_HTML_ABOUT_H_

#include <ceres_ed/report/html/page.h>

#include <nlohmann/json.hpp>

namespace ceres_ed {

void AddAbout(const nlohmann::ordered_json& report, HtmlPage* page);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_ABOUT_H_
