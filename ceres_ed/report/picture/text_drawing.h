// Words in pictures.
#ifndef CERES_ED_REPORT_PICTURE_TEXT_DRAWING_H_
#define CERES_ED_REPORT_PICTURE_TEXT_DRAWING_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/report/view/color_map.h>

#include <string>

namespace ceres_ed {

// Returns the width of a text in pixels; `size` is the height of its line in pixels.
double TextWidth(const std::string& text, double size);

// Draws a text whose baseline begins at (x, y). What lies outside the picture is left out, and so
// is a character that the font does not have.
void DrawText(const std::string& text,
              double x,
              double y,
              double size,
              const Rgb& color,
              ColorImage* picture);

// Returns the beginning of a text that is at most `width` pixels wide, with "..." if some is
// missing.
std::string FitText(const std::string& text, double size, double width);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_PICTURE_TEXT_DRAWING_H_
