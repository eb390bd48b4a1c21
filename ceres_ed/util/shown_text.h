// Text from users as it can be shown on a terminal.
#ifndef CERES_ED_UTIL_SHOWN_TEXT_H_
#define CERES_ED_UTIL_SHOWN_TEXT_H_

#include <string>
#include <string_view>

namespace ceres_ed {

// Returns `text` with '?' for each control character except line feeds and tabs, among them the
// escape character, with which a terminal is controlled: the name of a file may contain them, and
// a message that shows the name must not. Bytes of UTF-8 stay, but the control characters U+0080 to
// U+009F become '?'.
std::string ShownText(std::string_view text);

// Returns the same with '?' for line feeds and tabs, too: text that is part of a sentence.
std::string ShownLine(std::string_view text);

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_SHOWN_TEXT_H_
