// The flags of a program, which are made from the rows of its options (ceres_ed/util/options.h).
#ifndef CERES_ED_APPS_SUPPORT_OPTION_FLAGS_H_
#define CERES_ED_APPS_SUPPORT_OPTION_FLAGS_H_

#include <ceres_ed/util/options.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <variant>
#include <vector>

#include <gflags/gflags.h>

namespace ceres_ed {

// The file name that gflags is told for these flags. It distinguishes them from flags of libraries.
constexpr char kOptionFlagsFile[] = "ceres_ed options";

// A flag that is registered with gflags. Its address never changes.
struct OptionFlag {
  using Value = std::variant<bool, gflags::int32, gflags::uint64, double, std::string>;

  // It must exist until the program ends.
  const Option* option = nullptr;
  // The allowed values, for example "a finite number > 0 (0 = unlimited)".
  std::string expected;
  // The names of an enum or the words for a bool, separated by commas; empty if there are none.
  std::string names;
  Value value;
  Value default_value;
};

// Registers a flag for an option. Its default is the value of `field`, which is copied.
const OptionFlag* RegisterOptionFlag(const Option& option, const OptionField& field);

// Sets `field` to the value of a flag. The error is "--<name>=<value>, expected <what>".
Status ReadOptionFlag(const OptionFlag& flag, const OptionField& field);

// Returns the registered flags, which are those of the program, in the order of registration.
const std::vector<const OptionFlag*>& RegisteredOptionFlags();

// Returns the flag with this name or this letter, or null.
const OptionFlag* FindOptionFlag(const std::string& name);

// The flags of a struct of settings. An object at namespace scope registers them before main()
// begins.
template <typename Settings>
class OptionFlags {
 public:
  // `table` must exist until the program ends.
  explicit OptionFlags(const OptionTable<Settings>& table) : table_(table) {
    Settings defaults;
    for (const auto& row : table_) {
      const bool is_flag = row.option.group != OptionGroup::kInternal;
      flags_.push_back(is_flag ? RegisterOptionFlag(row.option, row.field(&defaults)) : nullptr);
    }
  }

  // Returns the settings that the flags have now. The error names the first flag that is out of its
  // range, its value, and what was expected.
  StatusOr<Settings> Read() const {
    Settings settings;
    std::size_t next = 0;
    for (const auto& row : table_) {
      const OptionFlag* flag = flags_[next++];
      if (flag == nullptr) continue;
      const Status status = ReadOptionFlag(*flag, row.field(&settings));
      if (!status.ok()) return status;
    }
    return settings;
  }

 private:
  const OptionTable<Settings>& table_;
  // One for each row; null for a row that is not a flag.
  std::vector<const OptionFlag*> flags_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SUPPORT_OPTION_FLAGS_H_
