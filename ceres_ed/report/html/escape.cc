#include "ceres_ed/report/html/escape.h"

#include <ceres_ed/report/view/utf8.h>

#include <cstddef>

namespace ceres_ed {

std::string EscapeHtml(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  while (!text.empty()) {
    const Utf8Character character = ReadUtf8(text);
    if (character.code == kReplacementCharacter) {
      escaped += "\xEF\xBF\xBD";
    } else if (character.code == '&') {
      escaped += "&amp;";
    } else if (character.code == '<') {
      escaped += "&lt;";
    } else if (character.code == '>') {
      escaped += "&gt;";
    } else if (character.code == '"') {
      escaped += "&quot;";
    } else if (character.code == '\'') {
      escaped += "&#39;";
    } else {
      escaped += text.substr(0, character.size);
    }
    text.remove_prefix(character.size);
  }
  return escaped;
}

std::string JsonForScript(const nlohmann::ordered_json& value) {
  const std::string json = value.dump(
      /*indent=*/-1, ' ', /*ensure_ascii=*/true, nlohmann::ordered_json::error_handler_t::replace);
  std::string escaped;
  escaped.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      escaped += "\\u003c";
    } else if (c == '>') {
      escaped += "\\u003e";
    } else if (c == '&') {
      escaped += "\\u0026";
    } else if (c == '\x7f') {
      escaped += "\\u007f";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

}  // namespace ceres_ed
