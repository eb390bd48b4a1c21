// The files that every page has in it: they are put into the library when it is built.
#ifndef CERES_ED_REPORT_HTML_ASSETS_H_
#define CERES_ED_REPORT_HTML_ASSETS_H_

#include <string_view>

namespace ceres_ed {

// The style sheet, and the scripts of the view.
std::string_view ReportCss();
std::string_view ReportJs();
// The script of the page of a cohort.
std::string_view CohortJs();

// three.js and its OrbitControls; empty if libjs-three was not there when the library was built.
std::string_view ThreeJs();
std::string_view OrbitControlsJs();
// The licence of three.js.
std::string_view ThreeLicense();

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_ASSETS_H_
