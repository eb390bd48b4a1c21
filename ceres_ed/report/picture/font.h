// The font of pictures, which is put into the library when it is built.
#ifndef CERES_ED_REPORT_PICTURE_FONT_H_
#define CERES_ED_REPORT_PICTURE_FONT_H_

#include <string_view>

namespace ceres_ed {

// Returns a TrueType file: DejaVu Sans, whose licence allows to hand it on in programs.
std::string_view FontFile();

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_PICTURE_FONT_H_
