#include "ceres_ed/util/options.h"

#include <charconv>
#include <cmath>

namespace ceres_ed {
namespace {

// Writes the number in a field. Returns false if the field is not a number.
bool NumberOf(const OptionField& field, double* value) {
  if (const auto* whole = std::get_if<int*>(&field)) {
    *value = **whole;
  } else if (const auto* large = std::get_if<std::uint64_t*>(&field)) {
    *value = static_cast<double>(**large);
  } else if (const auto* real = std::get_if<double*>(&field)) {
    *value = **real;
  } else {
    return false;
  }
  return true;
}

template <typename Wanted>
std::string Expected(const Option& option, const OptionField& field, Wanted wanted) {
  if (const auto* named = std::get_if<NamedField>(&field)) return named->list(" or ");
  const bool is_whole =
      std::holds_alternative<int*>(field) || std::holds_alternative<std::uint64_t*>(field);
  std::string text = option.range.Text(is_whole);
  for (const SpecialValue& special : option.specials) {
    if (wanted(special)) text += " (" + NumberText(special.on_flag) + " = " + special.word + ")";
  }
  return text;
}

struct TextOf {
  std::string operator()(const bool* value) const { return *value ? "true" : "false"; }
  std::string operator()(const int* value) const { return std::to_string(*value); }
  std::string operator()(const std::uint64_t* value) const { return std::to_string(*value); }
  std::string operator()(const double* value) const { return NumberText(*value); }
  std::string operator()(const std::string* value) const { return *value; }
  std::string operator()(const NamedField& field) const { return field.get(field.value); }
};

}  // namespace

bool OptionRange::Contains(double value) const {
  if (std::isnan(value)) return false;
  if (std::isinf(value) && !with_infinity) return false;
  const bool above = open_below ? value > lowest : value >= lowest;
  const bool below = open_above ? value < highest : value <= highest;
  return above && below;
}

std::string OptionRange::Text(bool is_whole) const {
  // A large whole number is not written with an exponent.
  const auto text = [is_whole](double value) {
    return is_whole ? std::to_string(std::llround(value)) : NumberText(value);
  };
  std::string kind = is_whole ? "a whole number" : with_infinity ? "a number" : "a finite number";
  if (std::isinf(lowest) && std::isinf(highest)) return kind;
  if (std::isinf(highest)) return kind + (open_below ? " > " : " >= ") + text(lowest);
  if (is_whole) return kind + " from " + text(lowest) + " to " + text(highest);
  return kind + " in " + (open_below ? "(" : "[") + text(lowest) + ", " + text(highest) +
         (open_above ? ")" : "]");
}

OptionRange AtLeast(double lowest) {
  OptionRange range;
  range.lowest = lowest;
  return range;
}

OptionRange Above(double bound) {
  OptionRange range = AtLeast(bound);
  range.open_below = true;
  return range;
}

OptionRange AboveOrInfinite(double bound) {
  OptionRange range = Above(bound);
  range.with_infinity = true;
  return range;
}

OptionRange Between(double lowest, double highest) {
  OptionRange range = AtLeast(lowest);
  range.highest = highest;
  return range;
}

OptionRange AboveUpTo(double bound, double highest) {
  OptionRange range = Between(bound, highest);
  range.open_below = true;
  return range;
}

OptionRange Inside(double lowest, double highest) {
  OptionRange range = AboveUpTo(lowest, highest);
  range.open_above = true;
  return range;
}

std::string NumberText(double value) {
  constexpr int kLongest = 64;
  char text[kLongest];
  return std::string(text, std::to_chars(text, text + kLongest, value).ptr);
}

std::string OptionText(const OptionField& field) { return std::visit(TextOf(), field); }

std::string ExpectedText(const Option& option, const OptionField& field) {
  return Expected(
      option, field, [](const SpecialValue& special) { return special.on_flag == special.value; });
}

std::string ExpectedOnFlag(const Option& option, const OptionField& field) {
  return Expected(option, field, [](const SpecialValue&) { return true; });
}

bool CheckOption(const Option& option, const OptionField& field, std::string* error) {
  double value = 0.0;
  if (!NumberOf(field, &value) || option.range.Contains(value)) return true;
  for (const SpecialValue& special : option.specials) {
    // A number that is used only on the command line is not stored in the member.
    if (special.on_flag == special.value && special.value == value) return true;
  }
  *error = option.name + " is " + OptionText(field) + ", expected " + ExpectedText(option, field);
  return false;
}

}  // namespace ceres_ed
