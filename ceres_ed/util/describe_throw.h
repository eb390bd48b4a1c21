// Turns exceptions of user code into sentences.
#ifndef CERES_ED_UTIL_DESCRIBE_THROW_H_
#define CERES_ED_UTIL_DESCRIBE_THROW_H_

#include <exception>
#include <string>

namespace ceres_ed {

// Calls `body`. Returns "threw: <message>" if it throws, and an empty string if it does not.
template <typename Body>
std::string DescribeThrow(const Body& body) {
  try {
    body();
    return "";
  } catch (const std::exception& error) {
    return std::string("threw: ") + error.what();
  } catch (...) {
    return "threw something that is no std::exception";
  }
}

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_DESCRIBE_THROW_H_
