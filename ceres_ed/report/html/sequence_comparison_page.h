// The page of several runs of tracking beside each other.
#ifndef CERES_ED_REPORT_HTML_SEQUENCE_COMPARISON_PAGE_H_
#define CERES_ED_REPORT_HTML_SEQUENCE_COMPARISON_PAGE_H_

#include <ceres_ed/report/html/sequence_page.h>

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// A run with its report.json, and what there is to see of it.
struct ComparedSequence {
  // What the user calls it: the path of its report, or of its folder.
  std::string name;
  nlohmann::ordered_json report;
  SequenceView view;
};

// Returns the scene of all maps as they are at the end, with one camera.
Scene SceneOfSequences(const std::vector<ComparedSequence>& runs);

// Returns the page: figures, flags that differ, the maps in `scene`, and the figures of the frames.
// `picture_png` is that of AddViewer() (viewer.h).
std::string SequenceComparisonPage(const std::vector<ComparedSequence>& runs,
                                   const Scene& scene,
                                   const std::string& picture_png);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_SEQUENCE_COMPARISON_PAGE_H_
