#include "ceres_ed/io/video/stacking.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ceres_ed {
namespace {

// The green channel, which is close to the brightness.
double Green(const ColorImage& picture, int u, int v) { return picture(u, v)[1]; }

// The mean absolute difference of rows that are `step` apart.
double RowDifference(const ColorImage& picture, int step) {
  double sum = 0.0;
  std::size_t count = 0;
  for (int v = 0; v + step < picture.height(); ++v) {
    for (int u = 0; u < picture.width(); u += 2) {
      sum += std::abs(Green(picture, u, v) - Green(picture, u, v + step));
      ++count;
    }
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

// Neighbouring rows are more alike than rows that are two apart, unless they belong to two cameras.
bool HasRowsInTurn(const ColorImage& picture) {
  constexpr double kClearly = 1.2;
  return RowDifference(picture, 1) > kClearly * RowDifference(picture, 2);
}

// A part of a picture.
struct Part {
  int u = 0;
  int v = 0;
  int width = 0;
  int height = 0;
};

// The correlation of two parts of the same size, of which the second one is shifted to the left by
// `shift` pixels.
double Correlation(const ColorImage& picture, const Part& a, const Part& b, int shift) {
  double n = 0.0;
  double sum_a = 0.0;
  double sum_b = 0.0;
  double sum_aa = 0.0;
  double sum_bb = 0.0;
  double sum_ab = 0.0;
  const int step = std::max(1, std::min(a.width, a.height) / 100);
  for (int v = 0; v < a.height; v += step) {
    for (int u = std::max(0, shift); u < a.width + std::min(0, shift); u += step) {
      const double value_a = Green(picture, a.u + u, a.v + v);
      const double value_b = Green(picture, b.u + u - shift, b.v + v);
      n += 1.0;
      sum_a += value_a;
      sum_b += value_b;
      sum_aa += value_a * value_a;
      sum_bb += value_b * value_b;
      sum_ab += value_a * value_b;
    }
  }
  if (n == 0.0) return 0.0;
  const double variance = (sum_aa - sum_a * sum_a / n) * (sum_bb - sum_b * sum_b / n);
  return variance > 0.0 ? (sum_ab - sum_a * sum_b / n) / std::sqrt(variance) : 0.0;
}

// The highest correlation at any disparity up to a quarter of the width.
double BestCorrelation(const ColorImage& picture, const Part& a, const Part& b) {
  double best = -1.0;
  const int most = a.width / 4;
  const int step = std::max(1, a.width / 100);
  for (int shift = -most; shift <= most; shift += step) {
    best = std::max(best, Correlation(picture, a, b, shift));
  }
  return best;
}

bool LooksVertical(const ColorImage& picture) {
  const int half_height = picture.height() / 2;
  const int half_width = picture.width() / 2;
  const double vertical = BestCorrelation(picture,
                                          {0, 0, picture.width(), half_height},
                                          {0, half_height, picture.width(), half_height});
  const double horizontal = BestCorrelation(
      picture, {0, 0, half_width, picture.height()}, {half_width, 0, half_width, picture.height()});
  return vertical >= horizontal;
}

}  // namespace

const char* StackingText(Stacking stacking) {
  switch (stacking) {
    case Stacking::kVertical:
      return "the left picture above the right one";
    case Stacking::kHorizontal:
      return "the left picture to the left of the right one";
    case Stacking::kRows:
      return "rows of the left and of the right picture in turn";
  }
  return "";
}

StackingGuess GuessStacking(const ColorImage& picture, int width, int height) {
  StackingGuess guess;
  const char* reason = "by the content of the first frame";
  if (HasRowsInTurn(picture)) {
    guess.stacking = Stacking::kRows;
  } else if (width > 0 && picture.width() == width && picture.height() == 2 * height) {
    reason = "by the calibration's size";
  } else if (width > 0 && picture.width() == 2 * width && picture.height() == height) {
    guess.stacking = Stacking::kHorizontal;
    reason = "by the calibration's size";
  } else if (!LooksVertical(picture)) {
    guess.stacking = Stacking::kHorizontal;
  }
  guess.text = std::string(StackingText(guess.stacking)) + " (" + reason + ")";
  return guess;
}

}  // namespace ceres_ed
