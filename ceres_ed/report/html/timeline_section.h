// The section about the frames of a sequence.
#ifndef CERES_ED_REPORT_HTML_TIMELINE_SECTION_H_
#define CERES_ED_REPORT_HTML_TIMELINE_SECTION_H_

#include <ceres_ed/io/results/frames_csv.h>
#include <ceres_ed/report/html/page.h>

#include <string>
#include <utility>
#include <vector>

namespace ceres_ed {

// Adds a strip with the status of each frame, plots of its figures, and a table of both. A long
// sequence has some of its frames in the table, which says so.
void AddTimeline(const FrameLog& log, HtmlPage* page);

// Adds plots and figures of the frames that were compared with the batch solve; nothing if none
// was.
void AddVerification(const FrameLog& log, HtmlPage* page);

// Adds plots of the figures of several runs over their frames, each with its name.
void AddTimelines(const std::vector<std::pair<std::string, const FrameLog*>>& runs, HtmlPage* page);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_TIMELINE_SECTION_H_
