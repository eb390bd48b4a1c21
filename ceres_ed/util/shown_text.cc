#include "ceres_ed/util/shown_text.h"

#include <cstddef>

namespace ceres_ed {

std::string ShownText(std::string_view text) {
  std::string shown;
  shown.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool is_c0 = (c < 0x20 && c != '\n' && c != '\t') || c == 0x7f;
    // UTF-8 writes U+0080 to U+009F as C2 80 to C2 9F.
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : '\0');
    const bool is_c1 = c == 0xc2 && next >= 0x80 && next <= 0x9f;
    if (is_c0 || is_c1) {
      shown += '?';
      if (is_c1) ++i;
    } else {
      shown += text[i];
    }
  }
  return shown;
}

std::string ShownLine(std::string_view text) {
  std::string shown = ShownText(text);
  for (char& c : shown) {
    if (c == '\n' || c == '\t') c = '?';
  }
  return shown;
}

}  // namespace ceres_ed
