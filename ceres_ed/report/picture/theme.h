// The colours of pictures.
#ifndef CERES_ED_REPORT_PICTURE_THEME_H_
#define CERES_ED_REPORT_PICTURE_THEME_H_

#include <ceres_ed/report/view/color_map.h>
#include <ceres_ed/util/named_values.h>

#include <array>

namespace ceres_ed {

enum class Theme { kLight, kDark };

constexpr std::array<NamedValue<Theme>, 2> NamesOf(Theme) {
  return {{{"light", Theme::kLight}, {"dark", Theme::kDark}}};
}

struct ThemeColors {
  Rgb ground;
  Rgb text;
  // Less important words, and lines.
  Rgb soft;
  // Surfaces without a field: those that move, and the others.
  Rgb surface;
  Rgb other;
  Rgb edge;
};

constexpr ThemeColors ColorsOf(Theme theme) {
  if (theme == Theme::kDark) {
    return {{20, 23, 27},
            {230, 233, 237},
            {154, 164, 176},
            {154, 163, 174},
            {95, 136, 184},
            {190, 190, 190}};
  }
  return {
      {255, 255, 255}, {28, 32, 38}, {89, 98, 110}, {185, 192, 201}, {143, 179, 217}, {90, 90, 90}};
}

// Nodes that data reach, and those that they do not (Okabe and Ito 2008: people who do not tell red
// from green tell them apart); others are grey.
inline constexpr Rgb kPrColor = {0, 114, 178};
inline constexpr Rgb kPiColor = {230, 159, 0};
inline constexpr Rgb kOtherNodeColor = {136, 136, 136};
inline constexpr Rgb kLandmarkColor = {213, 94, 0};
// Points that are followed, in a picture, with a rim.
inline constexpr Rgb kMarkColor = {255, 210, 63};
inline constexpr Rgb kMarkRim = {0, 0, 0};

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_PICTURE_THEME_H_
