// Characters of texts from outside.
#ifndef CERES_ED_REPORT_VIEW_UTF8_H_
#define CERES_ED_REPORT_VIEW_UTF8_H_

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ceres_ed {

// What is shown in place of a byte that is not UTF-8, or of a harmful character.
inline constexpr std::uint32_t kReplacementCharacter = 0xFFFD;

struct Utf8Character {
  std::uint32_t code = kReplacementCharacter;
  // The number of bytes, at least 1.
  std::size_t size = 1;
};

// Reads the character at the beginning of `text`, which is not empty. It is kReplacementCharacter
// where the text is not UTF-8, and for characters that are not shown as a page or a picture needs
// it: control characters (but line ends and tabs), and those that turn the direction of writing.
Utf8Character ReadUtf8(std::string_view text);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_VIEW_UTF8_H_
