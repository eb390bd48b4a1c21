// Text files of rows: fields set apart by blanks, # comments.
#ifndef CERES_ED_IO_TEXT_ROWS_H_
#define CERES_ED_IO_TEXT_ROWS_H_

#include <ceres_ed/util/status.h>

#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace ceres_ed {

// What stands between the fields of a row.
inline constexpr std::string_view kFieldSeparators = ", \t\r\v\f";

// Returns ok when `read_line` was so on every line of the file that says something, else the first
// error. Lines come without their comment, which begins with #, and without blanks at their ends;
// the first line has number 1. A byte order mark is skipped, and CR LF ends a line as LF does.
Status ForEachTextLine(
    const std::string& path,
    const std::function<Status(std::string_view line, int line_number)>& read_line);

// A line of a file that says something.
struct TextRow {
  // "FILE: line N: ", what an error begins with.
  std::string place;
  // At least one; they live as long as the call that hands them over.
  std::vector<std::string_view> fields;
};

// Returns ok when `read_row` was so on every row of the file, else the first error. Fields are set
// apart by blanks or commas; text behind # and blank lines are left out; LF or CR LF.
Status ForEachTextRow(const std::string& path,
                      const std::function<Status(const TextRow&)>& read_row);

// Returns the finite number that `text` is, or an error: "PLACE NAME is TEXT, expected ...".
StatusOr<double> ParseFinite(const std::string& place,
                             std::string_view name,
                             std::string_view text);

// Returns the whole number >= 0 that `text` is, or an error as of ParseFinite.
StatusOr<int> ParseNatural(const std::string& place, std::string_view name, std::string_view text);

// Appends the numbers, set apart by blanks, in as few digits as read back as the same; without
// exponent between 1e-6 and 1e16.
void AppendNumbers(std::initializer_list<double> numbers, std::string* row);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_TEXT_ROWS_H_
