// Stands in for png.cc and text_drawing.cc where stb or the font is missing.
#include <ceres_ed/report/picture/jpeg.h>
#include <ceres_ed/report/picture/png.h>
#include <ceres_ed/report/picture/text_drawing.h>

namespace ceres_ed {

bool HasPictures() { return false; }

std::string EncodePng(const ColorImage& /*picture*/) { return {}; }

std::string EncodeJpeg(const ColorImage& /*picture*/) { return {}; }

double TextWidth(const std::string& /*text*/, double /*size*/) { return 0.0; }

void DrawText(const std::string& /*text*/,
              double /*x*/,
              double /*y*/,
              double /*size*/,
              const Rgb& /*color*/,
              ColorImage* /*picture*/) {}

std::string FitText(const std::string& text, double /*size*/, double /*width*/) { return text; }

}  // namespace ceres_ed
