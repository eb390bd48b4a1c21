#include "apps/support/option_flags.h"

#include <cmath>
#include <deque>

#include <apps/support/command_line.h>

namespace ceres_ed {
namespace {

struct Registry {
  // A deque does not move its elements: gflags stores the addresses of the values.
  std::deque<OptionFlag> storage;
  std::vector<const OptionFlag*> flags;
};

// Returns the registry. It is never destroyed, because gflags reads the values until the program
// ends.
Registry& GetRegistry() {
  static Registry* registry = new Registry;
  return *registry;
}

// Converts the value of a field to the value of its flag.
struct ToFlagValue {
  const Option& option;

  OptionFlag::Value operator()(const bool* value) const {
    if (option.word_for_true.empty()) return *value;
    return *value ? option.word_for_true : option.word_for_false;
  }
  OptionFlag::Value operator()(const int* value) const { return gflags::int32{*value}; }
  OptionFlag::Value operator()(const std::uint64_t* value) const { return gflags::uint64{*value}; }
  OptionFlag::Value operator()(const double* value) const {
    for (const SpecialValue& special : option.specials) {
      if (std::isinf(*value) && special.value == *value) return special.on_flag;
    }
    return *value;
  }
  OptionFlag::Value operator()(const std::string* value) const { return *value; }
  OptionFlag::Value operator()(const NamedField& field) const { return field.get(field.value); }
};

// Sets a field to the value of its flag. Returns false if the value is not allowed.
struct FromFlagValue {
  const OptionFlag& flag;

  bool operator()(bool* value) const {
    const Option& option = *flag.option;
    if (option.word_for_true.empty()) {
      *value = std::get<bool>(flag.value);
      return true;
    }
    const auto& word = std::get<std::string>(flag.value);
    *value = word == option.word_for_true;
    return *value || word == option.word_for_false;
  }
  bool operator()(int* value) const { return TakeNumber<gflags::int32>(value); }
  bool operator()(std::uint64_t* value) const { return TakeNumber<gflags::uint64>(value); }
  bool operator()(double* value) const { return TakeNumber<double>(value); }
  bool operator()(std::string* value) const {
    *value = std::get<std::string>(flag.value);
    return true;
  }
  bool operator()(const NamedField& field) const {
    return field.set(field.value, std::get<std::string>(flag.value));
  }

 private:
  template <typename OnFlag, typename T>
  bool TakeNumber(T* value) const {
    const OnFlag given = std::get<OnFlag>(flag.value);
    *value = static_cast<T>(given);
    for (const SpecialValue& special : flag.option->specials) {
      if (static_cast<double>(given) != special.on_flag) continue;
      *value = static_cast<T>(special.value);
      return true;
    }
    return flag.option->range.Contains(static_cast<double>(given));
  }
};

}  // namespace

const OptionFlag* RegisterOptionFlag(const Option& option, const OptionField& field) {
  Registry& registry = GetRegistry();
  OptionFlag& flag = registry.storage.emplace_back();
  flag.option = &option;
  flag.expected = option.word_for_true.empty()
                      ? ExpectedOnFlag(option, field)
                      : option.word_for_true + " or " + option.word_for_false;
  if (const auto* named = std::get_if<NamedField>(&field)) flag.names = named->list(", ");
  if (!option.word_for_true.empty()) {
    flag.names = option.word_for_true + ", " + option.word_for_false;
  }
  flag.value = std::visit(ToFlagValue{option}, field);
  flag.default_value = flag.value;
  std::visit(
      [&](auto& value) {
        using Value = std::decay_t<decltype(value)>;
        auto& default_value = std::get<Value>(flag.default_value);
        const gflags::FlagRegisterer registerer(
            option.name.c_str(), option.doc.c_str(), kOptionFlagsFile, &value, &default_value);
      },
      flag.value);
  registry.flags.push_back(&flag);
  return &flag;
}

Status ReadOptionFlag(const OptionFlag& flag, const OptionField& field) {
  if (std::visit(FromFlagValue{flag}, field)) return Status::Ok();
  const std::string& name = flag.option->name;
  return Status::Error("--" + name + "=" + CurrentValue(name) + ", expected " + flag.expected);
}

const std::vector<const OptionFlag*>& RegisteredOptionFlags() { return GetRegistry().flags; }

const OptionFlag* FindOptionFlag(const std::string& name) {
  for (const OptionFlag* flag : RegisteredOptionFlags()) {
    const Option& option = *flag->option;
    const bool is_letter = name.size() == 1 && name[0] == option.letter;
    if (is_letter || option.name == name) return flag;
  }
  return nullptr;
}

}  // namespace ceres_ed
