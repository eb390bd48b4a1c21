// The place of a page where its scene is shown in 3-D.
#ifndef CERES_ED_REPORT_HTML_VIEWER_H_
#define CERES_ED_REPORT_HTML_VIEWER_H_

#include <ceres_ed/report/html/assets.h>
#include <ceres_ed/report/html/page.h>
#include <ceres_ed/report/view/scene.h>

#include <string>

namespace ceres_ed {

// Adds the view of `scene` to the page, with its controls, its legend, its data, and a sentence
// about how many points are shown. A page has one view. `picture_png` has the bytes of a picture
// that is shown in its place where there is no three.js, no script or no WebGL, and when the page
// is printed without them; it may be empty. `has_three` says whether there is three.js.
void AddViewer(const Scene& scene,
               const std::string& picture_png,
               HtmlPage* page,
               bool has_three = !ThreeJs().empty());

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_VIEWER_H_
