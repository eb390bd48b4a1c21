// The page of several runs beside each other.
#ifndef CERES_ED_REPORT_HTML_COMPARISON_PAGE_H_
#define CERES_ED_REPORT_HTML_COMPARISON_PAGE_H_

#include <ceres_ed/report/view/fit_view.h>

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// A run with its report.json, and what there is to see of it.
struct ComparedRun {
  // What the user calls it: the path of its report, or of its folder.
  std::string name;
  nlohmann::ordered_json report;
  FitView view;
};

// Returns the scene of all results (comparison_view.h).
Scene SceneOfRuns(const std::vector<ComparedRun>& runs);

// Returns the page: figures, flags that differ, and the results in `scene`. `picture_png` is that
// of AddViewer() (viewer.h).
std::string ComparisonPage(const std::vector<ComparedRun>& runs,
                           const Scene& scene,
                           const std::string& picture_png);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_COMPARISON_PAGE_H_
