// The section about the distances of a fit.
#ifndef CERES_ED_REPORT_HTML_DISTANCE_SECTION_H_
#define CERES_ED_REPORT_HTML_DISTANCE_SECTION_H_

#include <ceres_ed/report/html/page.h>
#include <ceres_ed/report/view/fit_view.h>

namespace ceres_ed {

// Adds histogram, cumulative curves and figures of all distances, and of the rigid placement
// against the fit. `diagonal` is that of the target, to which percentages refer; NaN if it is not
// known.
void AddDistances(const FitDistances& distances, double diagonal, HtmlPage* page);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_DISTANCE_SECTION_H_
