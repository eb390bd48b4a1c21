// What the header of an Options struct needs: the names of its enums, and the type of its rows.
//
// There is one table of names for each enum: flags, Python, reports and files all read it.
//
// An enum has names when a function NamesOf(E) stands beside it and returns them:
//   enum class Colour { kRed, kBlue };
//   constexpr std::array<NamedValue<Colour>, 2> NamesOf(Colour) {
//     return {{{"red", Colour::kRed}, {"blue", Colour::kBlue}}};
//   }
#ifndef CERES_ED_UTIL_NAMED_VALUES_H_
#define CERES_ED_UTIL_NAMED_VALUES_H_

#include <array>
#include <optional>
#include <string>

#include <glog/logging.h>

namespace ceres_ed {

// A value and its name.
template <typename E>
struct NamedValue {
  const char* name = "";
  E value = E();
};

// Returns the name of `value`, which must have one.
template <typename E>
std::string NameOf(E value) {
  for (const NamedValue<E>& named : NamesOf(E())) {
    if (named.value == value) return named.name;
  }
  LOG(FATAL) << "no name for the value " << static_cast<int>(value);
}

// Returns the value of that name, or nothing where no value has it.
template <typename E>
std::optional<E> FindByName(const std::string& name) {
  for (const NamedValue<E>& named : NamesOf(E())) {
    if (name == named.name) return named.value;
  }
  return std::nullopt;
}

// Returns all names of E in the order of its table, with `separator` between them.
template <typename E>
std::string ListNames(const char* separator) {
  std::string names;
  for (const NamedValue<E>& named : NamesOf(E())) {
    names += (names.empty() ? "" : separator) + std::string(named.name);
  }
  return names;
}

// The rows of an Options struct (options.h).
template <typename Options>
class OptionTable;

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_NAMED_VALUES_H_
