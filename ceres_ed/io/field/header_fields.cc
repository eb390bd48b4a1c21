#include "ceres_ed/io/field/header_fields.h"

#include <ceres_ed/io/field/file_start.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/util/text.h>

#include <optional>
#include <string_view>

namespace ceres_ed {

StatusOr<HeaderFields> ReadHeaderFields(const std::string& path,
                                        char separator,
                                        const std::string& last) {
  constexpr std::size_t kLongestHeader = 1 << 16;
  const StatusOr<std::string> text = ReadStart(path, kLongestHeader);
  if (!text.ok()) return text.status();
  HeaderFields fields;
  for (const std::string_view line : SplitLines(*text, '\n')) {
    if (Trim(line).empty()) break;
    const std::size_t end = line.find(separator);
    if (end == std::string_view::npos) continue;
    const std::string name(Trim(line.substr(0, end)));
    fields[name] = std::string(Trim(line.substr(end + 1)));
    if (name == last) break;
  }
  return fields;
}

StatusOr<std::vector<double>> NumbersOf(const std::string& path,
                                        const HeaderFields& fields,
                                        const std::string& name,
                                        std::size_t count) {
  const auto found = fields.find(name);
  const std::string value = found == fields.end() ? "" : found->second;
  std::vector<double> numbers;
  bool is_bad = false;
  for (const std::string_view word : SplitWords(value, " \t(),")) {
    if (word == "none") continue;
    const std::optional<double> number = ParseDouble(word);
    is_bad = is_bad || !number.has_value();
    numbers.push_back(number.value_or(0.0));
  }
  if (!is_bad && numbers.size() == count) return numbers;
  return Status::Error(path + ": the field '" + name + "' is " +
                       (found == fields.end() ? "missing" : Quoted(value)) + ", expected " +
                       std::to_string(count) + " numbers");
}

}  // namespace ceres_ed
