// The page of the tracking of a sequence.
#ifndef CERES_ED_REPORT_HTML_SEQUENCE_PAGE_H_
#define CERES_ED_REPORT_HTML_SEQUENCE_PAGE_H_

#include <ceres_ed/io/results/frames_csv.h>
#include <ceres_ed/report/view/scene.h>

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// The distances of map points to their true places in a moment, in metres.
struct MomentError {
  int frame = 0;
  double mean = 0.0;
  double median = 0.0;
  double p95 = 0.0;
};

struct SequenceView {
  Scene scene;
  FrameLog log;
  // Empty without truth.
  std::vector<MomentError> errors;
  // The number of live clouds of the run.
  int live_clouds = 0;
};

// Returns the page of a run. `report` is what its report.json has: members that are missing are
// left out. `evaluation` is the report of ed_eval on it, or null. `picture_png` is that of
// AddViewer() (viewer.h).
std::string SequencePage(const nlohmann::ordered_json& report,
                         const nlohmann::ordered_json& evaluation,
                         const SequenceView& view,
                         const std::string& picture_png);

// Returns a title such as "liver_breath_render, 60 frames".
std::string SequenceTitle(const nlohmann::ordered_json& report);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_SEQUENCE_PAGE_H_
