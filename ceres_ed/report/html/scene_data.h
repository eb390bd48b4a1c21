// A scene as data for the view in a page (assets/scripts/).
#ifndef CERES_ED_REPORT_HTML_SCENE_DATA_H_
#define CERES_ED_REPORT_HTML_SCENE_DATA_H_

#include <ceres_ed/report/view/scene.h>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Returns the scene: {"center", "radius", "camera", "surfaces", "graph", "landmarks", "panels",
// "colors", "field"}. Positions and values have 16 bits, in the box and the range of their surface
// and field; the motions of nodes are doubles.
nlohmann::ordered_json SceneData(const Scene& scene);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_SCENE_DATA_H_
