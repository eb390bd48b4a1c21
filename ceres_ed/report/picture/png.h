// PNG files.
#ifndef CERES_ED_REPORT_PICTURE_PNG_H_
#define CERES_ED_REPORT_PICTURE_PNG_H_

#include <ceres_ed/geometry/images.h>

#include <string>

namespace ceres_ed {

// Returns whether this build can draw and write pictures: stb (Debian's libstb-dev) and the font
// were there.
bool HasPictures();

// What is missing where it can not, as a part of a sentence.
inline constexpr char kNoPictures[] =
    "this build draws no pictures, because libstb-dev or fonts-dejavu-core was missing";

// Returns the bytes of a PNG file; empty for a picture without pixels and without HasPictures().
std::string EncodePng(const ColorImage& picture);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_PICTURE_PNG_H_
