// The message for an option that is out of range.
#ifndef CERES_ED_UTIL_OPTION_CHECK_H_
#define CERES_ED_UTIL_OPTION_CHECK_H_

#include <sstream>
#include <string>

namespace ceres_ed {

// Returns `holds`. If it is false, writes "<option> is <value>, expected <expected>" to `error`.
template <typename T>
bool RequireOption(
    bool holds, const char* option, T value, const char* expected, std::string* error) {
  if (holds) return true;
  std::ostringstream message;
  message << option << " is " << value << ", expected " << expected;
  *error = message.str();
  return false;
}

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_OPTION_CHECK_H_
