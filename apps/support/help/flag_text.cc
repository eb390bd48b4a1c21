#include "apps/support/help/flag_text.h"

#include <cstdlib>

namespace ceres_ed {
namespace {

// Returns a text such as "0 = automatic".
std::string SpecialsText(const Option& option) {
  std::string text;
  for (const SpecialValue& special : option.specials) {
    text += (text.empty() ? "" : ", ") + NumberText(special.on_flag) + " = " + special.word;
  }
  return text;
}

}  // namespace

std::vector<const OptionFlag*> FlagsOf(OptionGroup group) {
  std::vector<const OptionFlag*> flags;
  for (const OptionFlag* flag : RegisteredOptionFlags()) {
    if (flag->option->group == group) flags.push_back(flag);
  }
  return flags;
}

gflags::CommandLineFlagInfo InfoOf(const OptionFlag& flag) {
  return gflags::GetCommandLineFlagInfoOrDie(flag.option->name.c_str());
}

std::string TypeText(const gflags::CommandLineFlagInfo& flag) {
  if (flag.type == "bool") return "true|false";
  if (flag.type == "string") return "text";
  return flag.type == "double" ? "number" : "integer";
}

std::string ValueText(const gflags::CommandLineFlagInfo& flag, const std::string& value) {
  return flag.type == "double" ? NumberText(std::strtod(value.c_str(), nullptr)) : value;
}

std::string DefaultText(const OptionFlag& flag) {
  const gflags::CommandLineFlagInfo info = InfoOf(flag);
  return ValueText(info, info.default_value);
}

std::string DescriptionText(const OptionFlag& flag, const std::string& names) {
  const Option& option = *flag.option;
  std::string text = option.doc;
  if (!names.empty()) text += " One of " + names + ".";
  if (const std::string specials = SpecialsText(option); !specials.empty()) {
    text += " " + specials + ".";
  }
  const std::string fallback = DefaultText(flag);
  if (fallback.empty()) return text;
  return text + " [" + fallback + (option.unit.empty() ? "" : " " + option.unit) + "]";
}

}  // namespace ceres_ed
