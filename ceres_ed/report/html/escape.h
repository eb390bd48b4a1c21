// Makes texts from outside harmless in a page.
#ifndef CERES_ED_REPORT_HTML_ESCAPE_H_
#define CERES_ED_REPORT_HTML_ESCAPE_H_

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// Returns `text` for the content of an element or for an attribute in quotes: & < > " ' become
// references; control characters (but line ends and tabs), the characters that turn the direction
// of writing, and bytes that are not UTF-8 become U+FFFD.
std::string EscapeHtml(std::string_view text);

// Returns `value` as JSON for a <script> element. All that is not ASCII, and < > & and the control
// characters, are escaped, so that nothing in it ends the element or begins another. Bytes that are
// not UTF-8 become U+FFFD, and NaN and infinity null.
std::string JsonForScript(const nlohmann::ordered_json& value);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_HTML_ESCAPE_H_
