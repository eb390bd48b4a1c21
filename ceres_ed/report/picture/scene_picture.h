// A whole scene as a picture, for papers and terminals.
#ifndef CERES_ED_REPORT_PICTURE_SCENE_PICTURE_H_
#define CERES_ED_REPORT_PICTURE_SCENE_PICTURE_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/report/picture/theme.h>
#include <ceres_ed/report/view/scene.h>

#include <string>

namespace ceres_ed {

struct PictureOptions {
  // In pixels; the height follows. Words are legible at 300 dots per inch from 1500 pixels on.
  int width = 2000;
  Theme theme = Theme::kLight;
  // Two lines above the panels; an empty one is left out.
  std::string title;
  std::string subtitle;
  // The field that is shown; empty for the first one of the scene.
  std::string field;
};

// Returns the panels of a scene beside each other (at most four in a row), seen by one camera, with
// their titles, the colours of the field with its range, and a panel of the graph if there is one.
// It is empty if the scene has no panel.
ColorImage DrawScene(const Scene& scene, const PictureOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_PICTURE_SCENE_PICTURE_H_
