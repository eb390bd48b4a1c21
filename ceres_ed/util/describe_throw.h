// Exceptions of others' code as sentences.
#ifndef CERES_ED_UTIL_DESCRIBE_THROW_H_
#define CERES_ED_UTIL_DESCRIBE_THROW_H_

#include <exception>
#include <string>

namespace ceres_ed {

// Calls `body`, and returns "threw: <what it says>" where it throws; empty where it doesn't.
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
