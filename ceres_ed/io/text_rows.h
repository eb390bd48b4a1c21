// Reads text files that consist of rows: fields separated by blanks, and # comments.
#ifndef CERES_ED_IO_TEXT_ROWS_H_
#define CERES_ED_IO_TEXT_ROWS_H_

#include <ceres_ed/util/status.h>

#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace ceres_ed {

// The characters that separate the fields of a row.
inline constexpr std::string_view kFieldSeparators = ", \t\r\v\f";

// Calls `read_line` for every line of the file that has content, and returns its first error. A
// line is passed without its comment, which begins with #, and without blanks at its ends. The
// first line has number 1. A byte order mark is skipped, and lines end in LF or CR LF.
Status ForEachTextLine(
    const std::string& path,
    const std::function<Status(std::string_view line, int line_number)>& read_line);

// A line of a file that has content.
struct TextRow {
  // "FILE: line N: ", the beginning of an error message.
  std::string place;
  // The fields, at least one. They are valid only during the call that passes them.
  std::vector<std::string_view> fields;
};

// Calls `read_row` for every row of the file, and returns its first error. Fields are separated by
// blanks or commas. Text after # and blank lines are ignored; lines end in LF or CR LF.
Status ForEachTextRow(const std::string& path,
                      const std::function<Status(const TextRow&)>& read_row);

// Returns the number if `text` is a finite one, otherwise an error: "PLACE NAME is TEXT, expected
// ...".
StatusOr<double> ParseFinite(const std::string& place,
                             std::string_view name,
                             std::string_view text);

// Returns the number if `text` is a whole number >= 0, otherwise an error as that of ParseFinite().
StatusOr<int> ParseNatural(const std::string& place, std::string_view name, std::string_view text);

// Appends the numbers, separated by blanks, with the fewest digits from which the same number is
// read back. There is no exponent between 1e-6 and 1e16.
void AppendNumbers(std::initializer_list<double> numbers, std::string* row);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_TEXT_ROWS_H_
