// Flags that take one of a few words.
#ifndef CERES_ED_APPS_SUPPORT_CHOICES_H_
#define CERES_ED_APPS_SUPPORT_CHOICES_H_

#include <ceres_ed/util/status.h>

#include <cstddef>
#include <string>

#include <glog/logging.h>

namespace ceres_ed {

// A word and what it stands for.
template <typename T>
struct Choice {
  const char* name;
  T value;
  // False for a word that is reserved.
  bool available = true;
};

// Returns the word of an available value.
template <typename T, std::size_t kSize>
std::string NameOf(const Choice<T> (&choices)[kSize], T value) {
  for (const Choice<T>& choice : choices) {
    if (choice.available && choice.value == value) return choice.name;
  }
  LOG(FATAL) << "unnamed choice " << static_cast<int>(value);
}

// Sets `to` to what the word `name` stands for. Error: names the flag, the word and those expected.
template <typename T, std::size_t kSize>
Status Choose(const char* flag, const Choice<T> (&choices)[kSize], const std::string& name, T* to) {
  std::string known;
  const char* problem = "";
  for (const Choice<T>& choice : choices) {
    if (name == choice.name && choice.available) {
      *to = choice.value;
      return Status::Ok();
    }
    if (name == choice.name) problem = " is not available in this version";
    if (choice.available) known += std::string(known.empty() ? "" : " or ") + choice.name;
  }
  return Status::Error(std::string("--") + flag + "=" + name + problem + ", expected " + known);
}

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SUPPORT_CHOICES_H_
