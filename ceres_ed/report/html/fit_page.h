// The page of a fit.
#ifndef CERES_ED_REPORT_HTML_FIT_PAGE_H_
#define CERES_ED_REPORT_HTML_FIT_PAGE_H_

#include <ceres_ed/report/view/fit_view.h>

#include <string>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Returns the page of a fit or of the evaluation of one. `report` is what report.json has of it:
// members that are missing are left out. `picture_png` is that of AddViewer() (viewer.h).
std::string FitPage(const nlohmann::ordered_json& report,
                    const FitView& view,
                    const std::string& picture_png);

// Returns a title such as "heart/source.ply → target.ply", from the paths in a report.
std::string FitTitle(const nlohmann::ordered_json& report);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_FIT_PAGE_H_
