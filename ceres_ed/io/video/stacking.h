// How a stereo recording holds two pictures in one.
#ifndef CERES_ED_IO_VIDEO_STACKING_H_
#define CERES_ED_IO_VIDEO_STACKING_H_

#include <ceres_ed/geometry/images.h>

#include <string>

namespace ceres_ed {

// Where the left and the right picture are in one.
enum class Stacking {
  // The left picture above the right one.
  kVertical,
  // The left picture to the left of the right one.
  kHorizontal,
  // Rows of the left picture (0, 2, 4 ...) and of the right picture in turn.
  kRows,
};

// A stacking, and how it was found.
struct StackingGuess {
  Stacking stacking = Stacking::kVertical;
  // For example "the left picture above the right one (by the calibration's size)".
  std::string text;
};

// Decides how `picture`, the first one of a recording, holds two pictures. `width` and `height` are
// those of one picture as the calibration gives them, or 0 if unknown: where the sizes decide, they
// do; otherwise the two parts that resemble each other most.
StackingGuess GuessStacking(const ColorImage& picture, int width, int height);

// Returns "the left picture above the right one" and so on.
const char* StackingText(Stacking stacking);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_VIDEO_STACKING_H_
