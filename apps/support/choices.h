// Flags that take one of the names of an enum.
#ifndef CERES_ED_APPS_SUPPORT_CHOICES_H_
#define CERES_ED_APPS_SUPPORT_CHOICES_H_

#include <ceres_ed/util/named_values.h>
#include <ceres_ed/util/status.h>

#include <optional>
#include <string>

namespace ceres_ed {

// Sets `to` to the value of that name. Error: names the flag, the name and those expected.
template <typename E>
Status Choose(const char* flag, const std::string& name, E* to) {
  const std::optional<E> value = FindByName<E>(name);
  if (!value.has_value()) {
    return Status::Error("--" + std::string(flag) + "=" + name + ", expected " +
                         ListNames<E>(" or "));
  }
  *to = *value;
  return Status::Ok();
}

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SUPPORT_CHOICES_H_
