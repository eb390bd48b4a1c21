// Counts the members of an aggregate, to hold the rows of its options against them.
#ifndef CERES_ED_TEST_UTIL_OPTION_MEMBERS_H_
#define CERES_ED_TEST_UTIL_OPTION_MEMBERS_H_

#include <type_traits>
#include <utility>

namespace ceres_ed {

// Converts to the type of any member.
struct AnyMember {
  template <typename T>
  operator T() const;  // NOLINT(google-explicit-constructor)
};

template <typename T, typename Members, typename = void>
struct HasMembers : std::false_type {};

template <typename T, std::size_t... kIndex>
struct HasMembers<T,
                  std::index_sequence<kIndex...>,
                  std::void_t<decltype(T{(static_cast<void>(kIndex), AnyMember())...})>>
    : std::true_type {};

// Returns the number of members of T, an aggregate of at most 64.
template <typename T, std::size_t kCount = 64>
constexpr int CountMembers() {
  if constexpr (HasMembers<T, std::make_index_sequence<kCount>>::value) {
    return static_cast<int>(kCount);
  } else {
    static_assert(kCount > 0, "not an aggregate");
    return CountMembers<T, kCount - 1>();
  }
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_UTIL_OPTION_MEMBERS_H_
