#include "ceres_ed/report/view/utf8.h"

namespace ceres_ed {
namespace {

bool IsHarmful(std::uint32_t code) {
  if (code < 0x20U) return code != '\n' && code != '\t';
  return (code >= 0x7FU && code <= 0x9FU) || code == 0x061CU || code == 0x200EU ||
         code == 0x200FU || (code >= 0x2028U && code <= 0x202EU) ||
         (code >= 0x2066U && code <= 0x2069U) || code == 0xFEFFU;
}

}  // namespace

Utf8Character ReadUtf8(std::string_view text) {
  const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::uint32_t first = byte(0);
  if (first < 0x80U) return {IsHarmful(first) ? kReplacementCharacter : first, 1};
  const std::size_t size = first >= 0xF0U ? 4 : first >= 0xE0U ? 3 : 2;
  if (first < 0xC2U || first > 0xF4U || text.size() < size) return {};
  std::uint32_t code = first & (0xFFU >> (size + 1));
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    code = (code << 6U) | (byte(i) & 0x3FU);
  }
  // Longer codes than needed, and halves of surrogate pairs, are not UTF-8.
  constexpr std::uint32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xD800U && code <= 0xDFFFU;
  if (code < kSmallest[size] || code > 0x10FFFFU || is_surrogate) return {};
  return {IsHarmful(code) ? kReplacementCharacter : code, size};
}

}  // namespace ceres_ed
