// Several runs beside each other.
#ifndef CERES_ED_REPORT_VIEW_COMPARISON_VIEW_H_
#define CERES_ED_REPORT_VIEW_COMPARISON_VIEW_H_

#include <ceres_ed/report/view/fit_view.h>

#include <string>
#include <vector>

namespace ceres_ed {

// Returns a scene of the results of several fits in one frame, each in a panel with its name from
// `names`, which has the same size; the colours have one range for all. The first target is a
// panel, too. Results stand still, and have no graph.
Scene CompareScenes(const std::vector<const Scene*>& scenes, const std::vector<std::string>& names);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_VIEW_COMPARISON_VIEW_H_
