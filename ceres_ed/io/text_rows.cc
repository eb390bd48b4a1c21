#include "ceres_ed/io/text_rows.h"

#include <ceres_ed/io/text.h>
#include <ceres_ed/util/text.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <system_error>

namespace ceres_ed {
namespace {

// Spreadsheet programs write one at the start of a CSV file.
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

}  // namespace

Status ForEachTextLine(
    const std::string& path,
    const std::function<Status(std::string_view line, int line_number)>& read_line) {
  const StatusOr<std::string> contents = ReadWholeFile(path);
  if (!contents.ok()) return contents.status();
  std::string_view rest = *contents;
  if (rest.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
    rest.remove_prefix(kByteOrderMark.size());
  }
  int line_number = 0;
  for (const std::string_view line : SplitLines(rest, '\n')) {
    ++line_number;
    const std::string_view text = Trim(line.substr(0, line.find('#')));
    if (text.empty()) continue;
    Status status = read_line(text, line_number);
    if (!status.ok()) return status;
  }
  return Status::Ok();
}

Status ForEachTextRow(const std::string& path,
                      const std::function<Status(const TextRow&)>& read_row) {
  return ForEachTextLine(path, [&](std::string_view line, int line_number) {
    TextRow row;
    row.fields = SplitWords(line, kFieldSeparators);
    if (row.fields.empty()) return Status::Ok();
    row.place = path + ": line " + std::to_string(line_number) + ": ";
    return read_row(row);
  });
}

StatusOr<double> ParseFinite(const std::string& place,
                             std::string_view name,
                             std::string_view text) {
  const std::optional<double> value = ParseDouble(text);
  if (!value.has_value() || !std::isfinite(*value)) {
    return Status::Error(place + std::string(name) + " is " + Quoted(text) +
                         ", expected a finite number");
  }
  return *value;
}

StatusOr<int> ParseNatural(const std::string& place, std::string_view name, std::string_view text) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, value);
  if (result.ptr != end || result.ec != std::errc() || value < 0) {
    return Status::Error(place + std::string(name) + " is " + Quoted(text) +
                         ", expected a whole number from 0 to 2147483647");
  }
  return value;
}

void AppendNumbers(std::initializer_list<double> numbers, std::string* row) {
  constexpr std::size_t kLongestDouble = 64;
  for (const double number : numbers) {
    if (!row->empty() && row->back() != '\n' && row->back() != ' ') *row += ' ';
    // The shortest form of 100000 is 1e+05, which is not a valid frame number and hard to read.
    const double magnitude = std::abs(number);
    const bool plain = magnitude == 0.0 || (magnitude >= 1e-6 && magnitude < 1e16);
    char text[kLongestDouble];
    char* const end = text + sizeof(text);
    row->append(text,
                plain ? std::to_chars(text, end, number, std::chars_format::fixed).ptr
                      : std::to_chars(text, end, number).ptr);
  }
}

}  // namespace ceres_ed
