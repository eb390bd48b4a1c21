// A timeline as data for the scripts of a page (assets/scripts/timeline.js).
#ifndef CERES_ED_REPORT_HTML_TIMELINE_DATA_H_
#define CERES_ED_REPORT_HTML_TIMELINE_DATA_H_

#include <ceres_ed/report/view/timeline.h>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Returns {"frames", "moments", "poses", "camera", "pictures", "tracks"}. Poses have seven doubles
// a frame (position, and rotation w x y z), NaN where the camera is not known; pictures are JPEG,
// or null.
nlohmann::ordered_json TimelineData(const Timeline& timeline);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_TIMELINE_DATA_H_
