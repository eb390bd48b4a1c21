// Cuts text into pieces. The pieces point into the text.
#ifndef CERES_ED_UTIL_TEXT_H_
#define CERES_ED_UTIL_TEXT_H_

#include <string_view>
#include <vector>

namespace ceres_ed {

// Returns the text without the blanks at its ends.
std::string_view Trim(std::string_view text);

// Returns the pieces between the separators, one more than there are separators.
std::vector<std::string_view> SplitFields(std::string_view text, char separator);

// Returns the pieces that end at a separator or at the end of the text. A separator at the end adds
// no empty piece, and an empty text has no pieces.
std::vector<std::string_view> SplitLines(std::string_view text, char separator);

// Returns the longest pieces without any of the separators; none of them is empty.
std::vector<std::string_view> SplitWords(std::string_view text, std::string_view separators);

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_TEXT_H_
