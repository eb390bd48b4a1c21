// Options as data: one row for each member of an Options struct. IsValid(), the flags of the
// programs, the attributes in Python and the tables in the pages all come from these rows.
//
//   const OptionTable<BlurOptions>& BlurOptions::Rows() {
//     using O = BlurOptions;
//     static const OptionTable<O> rows({
//         Row(&O::radius, "radius", "Pixels around each one that are averaged.")
//             .In(AtLeast(1)).Unit("pixels"),
//         Nested(&O::border, BorderOptions::Rows(), "border_"),
//         NotData(&O::should_stop),
//     });
//     return rows;
//   }
#ifndef CERES_ED_UTIL_OPTIONS_H_
#define CERES_ED_UTIL_OPTIONS_H_

#include <ceres_ed/util/named_values.h>

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <glog/logging.h>

namespace ceres_ed {

// The group of an option in the help of a program.
enum class OptionGroup {
  // Files that are read or written.
  kFiles,
  // Options for most users.
  kMain,
  // Options that few users need.
  kExpert,
  // Options that the library sets itself. They are neither a flag nor an attribute in Python.
  kInternal,
};

// Whether an option may be changed when a run is continued from a checkpoint.
enum class ResumeRule {
  // It must not change.
  kKeep,
  // It may change, and the run reports it: the result has the same kind of contents but not the
  // same bytes.
  kNoted,
  // It may change, and the run does not report it.
  kFree,
};

// The values that a number may take. NaN is never among them.
struct OptionRange {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  // True if the end itself is not in the range.
  bool open_below = false;
  bool open_above = false;
  // True if an infinite value is in the range.
  bool with_infinity = false;

  bool Contains(double value) const;
  // Returns a text such as "a whole number >= 1" or "a finite number in (0, 180]".
  std::string Text(bool is_whole) const;
};

// [lowest, infinity).
OptionRange AtLeast(double lowest);
// (bound, infinity).
OptionRange Above(double bound);
// (bound, infinity].
OptionRange AboveOrInfinite(double bound);
// [lowest, highest].
OptionRange Between(double lowest, double highest);
// (bound, highest].
OptionRange AboveUpTo(double bound, double highest);
// (lowest, highest).
OptionRange Inside(double lowest, double highest);

// A number with a special meaning.
struct SpecialValue {
  // The number for it on the command line, in addition to `word`.
  double on_flag = 0.0;
  // The value of the member.
  double value = 0.0;
  // The word for it, for example "automatic".
  std::string word;
};

// A reference to a member that is an enum with names (named_values.h).
struct NamedField {
  void* value = nullptr;
  std::string (*get)(const void* value) = nullptr;
  // Returns false if no value has that name.
  bool (*set)(void* value, const std::string& name) = nullptr;
  std::string (*list)(const char* separator) = nullptr;
};

// A reference to a member.
using OptionField = std::variant<bool*, int*, std::uint64_t*, double*, std::string*, NamedField>;

// The description of an option.
struct Option {
  // The name of the flag, of the attribute in Python, and in messages.
  std::string name;
  // One letter for the command line; 0 = none.
  char letter = 0;
  // One sentence in plain English.
  std::string doc;
  // The unit, for example "pixels"; empty if there is none.
  std::string unit;
  OptionGroup group = OptionGroup::kExpert;
  // The range of a number.
  OptionRange range;
  std::vector<SpecialValue> specials;
  // The words for true and false on the command line, if the flag of a bool takes words.
  std::string word_for_true;
  std::string word_for_false;
  // The text that the flag means without a value; empty if it needs one.
  std::string text_alone;
  ResumeRule resume = ResumeRule::kKeep;
};

// Returns a number with the fewest digits from which the same number is read back.
std::string NumberText(double value);

// Returns the value of a field as text.
std::string OptionText(const OptionField& field);

// Returns what is expected of a field: its range or its names.
std::string ExpectedText(const Option& option, const OptionField& field);

// Does the same for a flag, which also accepts the special values that no member has.
std::string ExpectedOnFlag(const Option& option, const OptionField& field);

// Returns whether a field is in its range. If it is not, writes "<name> is <value>, expected
// <expected>" to `error`.
bool CheckOption(const Option& option, const OptionField& field, std::string* error);

// One or more rows; see Row(), Nested() and NotData().
template <typename Options>
class OptionRows {
 public:
  struct OneRow {
    Option option;
    std::function<OptionField(Options*)> field;
  };

  explicit OptionRows(std::vector<OneRow> rows) : rows_(std::move(rows)) {}

  const std::vector<OneRow>& rows() const { return rows_; }

  // These change all of the rows; a table has most of them for one row. They work on temporaries:
  // every program makes its tables when it starts, so nothing is copied.
  OptionRows&& In(const OptionRange& range) && {
    return With([&range](Option* option) { option->range = range; });
  }
  OptionRows&& Unit(const char* unit) && {
    return With([unit](Option* option) { option->unit = unit; });
  }
  OptionRows&& Group(OptionGroup group) && {
    return With([group](Option* option) { option->group = group; });
  }
  OptionRows&& File() && { return std::move(*this).Group(OptionGroup::kFiles); }
  OptionRows&& Main() && { return std::move(*this).Group(OptionGroup::kMain); }
  OptionRows&& Letter(char letter) && {
    return With([letter](Option* option) { option->letter = letter; });
  }
  OptionRows&& OnResume(ResumeRule rule) && {
    return With([rule](Option* option) { option->resume = rule; });
  }
  // `word` stands for `value`, on the command line and in the member.
  OptionRows&& Special(double value, const char* word) && {
    return std::move(*this).Special(value, value, word);
  }
  // `word` and `on_flag` stand for `value` on the command line.
  OptionRows&& Special(double on_flag, double value, const char* word) && {
    return With([=](Option* option) { option->specials.push_back({on_flag, value, word}); });
  }
  // A bool whose flag takes words.
  OptionRows&& Words(const char* for_true, const char* for_false) && {
    return With([=](Option* option) {
      option->word_for_true = for_true;
      option->word_for_false = for_false;
    });
  }
  // A text whose flag may stand without a value, and then means `text`.
  OptionRows&& Alone(const char* text) && {
    return With([=](Option* option) { option->text_alone = text; });
  }
  // For rows of a nested struct: the member of that name is set by the library.
  OptionRows&& Internal(const std::string& name) && {
    return Change(name, [](Option* option) { option->group = OptionGroup::kInternal; });
  }

 private:
  template <typename F>
  OptionRows&& With(F change) {
    for (OneRow& row : rows_) change(&row.option);
    return std::move(*this);
  }
  template <typename F>
  OptionRows&& Change(const std::string& name, F change) {
    int found = 0;
    for (OneRow& row : rows_) {
      if (row.option.name != name) continue;
      change(&row.option);
      ++found;
    }
    CHECK_EQ(found, 1) << "rows named " << name;
    return std::move(*this);
  }

  std::vector<OneRow> rows_;
};

namespace internal {

template <typename T>
OptionField FieldOf(T* member) {
  if constexpr (std::is_enum_v<T>) {
    return NamedField{member,
                      [](const void* value) { return NameOf(*static_cast<const T*>(value)); },
                      [](void* value, const std::string& name) {
                        const std::optional<T> found = FindByName<T>(name);
                        if (found.has_value()) *static_cast<T*>(value) = *found;
                        return found.has_value();
                      },
                      [](const char* separator) { return ListNames<T>(separator); }};
  } else {
    return member;
  }
}

}  // namespace internal

// Returns the row of a member: a bool, a number, a text, or an enum with names.
template <typename Options, typename T>
OptionRows<Options> Row(T Options::*member, const char* name, const char* doc) {
  typename OptionRows<Options>::OneRow row;
  row.option.name = name;
  row.option.doc = doc;
  row.field = [member](Options* options) { return internal::FieldOf(&(options->*member)); };
  std::vector<typename OptionRows<Options>::OneRow> rows;
  rows.push_back(std::move(row));
  return OptionRows<Options>(std::move(rows));
}

// Returns the rows of a member that is an Options struct itself, with `prefix` before all names but
// those in `as_they_are`.
template <typename Options, typename Inner>
OptionRows<Options> Nested(Inner Options::*member,
                           const OptionTable<Inner>& table,
                           const std::string& prefix = "",
                           const std::set<std::string>& as_they_are = {}) {
  std::vector<typename OptionRows<Options>::OneRow> rows;
  for (const auto& inner : table) {
    typename OptionRows<Options>::OneRow row;
    row.option = inner.option;
    if (as_they_are.count(row.option.name) == 0) row.option.name = prefix + row.option.name;
    row.field = [member, field = inner.field](Options* options) {
      return field(&(options->*member));
    };
    rows.push_back(std::move(row));
  }
  return OptionRows<Options>(std::move(rows));
}

// Stands for a member that is no data of this kind: a callback, or a list of structs.
template <typename Options, typename T>
OptionRows<Options> NotData(T Options::*) {
  return OptionRows<Options>({});
}

// The rows of an Options struct.
template <typename Options>
class OptionTable {
 public:
  using OneRow = typename OptionRows<Options>::OneRow;

  // One entry for each member of the struct. Rows that users see have names of their own.
  OptionTable(std::initializer_list<OptionRows<Options>> members)
      : num_members_(static_cast<int>(members.size())) {
    std::size_t num_rows = 0;
    for (const OptionRows<Options>& member : members) num_rows += member.rows().size();
    rows_.reserve(num_rows);
    for (const OptionRows<Options>& member : members) {
      for (const OneRow& row : member.rows()) {
        const bool is_hidden = row.option.group == OptionGroup::kInternal;
        CHECK(is_hidden || Find(row.option.name) == nullptr)
            << "two options are named " << row.option.name;
        rows_.push_back(row);
      }
    }
  }

  typename std::vector<OneRow>::const_iterator begin() const { return rows_.begin(); }
  typename std::vector<OneRow>::const_iterator end() const { return rows_.end(); }

  // The number of members of the struct that are in the table.
  int num_members() const { return num_members_; }

  // Returns the row of that name that users see, or null.
  const OneRow* Find(const std::string& name) const {
    for (const OneRow& row : rows_) {
      const bool is_hidden = row.option.group == OptionGroup::kInternal;
      if (!is_hidden && row.option.name == name) return &row;
    }
    return nullptr;
  }

  // Returns whether every option is in its range; `error` names the first that is not.
  bool Check(const Options& options, std::string* error) const {
    // A field is a reference to a member that may be written; here it is read.
    auto* members = const_cast<Options*>(&options);
    for (const OneRow& row : rows_) {
      if (!CheckOption(row.option, row.field(members), error)) return false;
    }
    return true;
  }

 private:
  std::vector<OneRow> rows_;
  int num_members_ = 0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_OPTIONS_H_
