// Tables of fields with commas between them.
#ifndef CERES_ED_IO_CSV_TABLE_H_
#define CERES_ED_IO_CSV_TABLE_H_

#include <ceres_ed/util/status.h>

#include <cstddef>
#include <string>
#include <vector>

namespace ceres_ed {

// A line of a table.
struct CsvRow {
  // "frames.csv: line 3: ", what an error begins with.
  std::string place;
  // At least one, without blanks around them; a field may be empty.
  std::vector<std::string> fields;

  // Ok when there are `count` fields.
  Status ExpectFields(std::size_t count) const;
};

// Returns the lines of a file that are neither blank nor a comment; text behind # is left out.
// Error: the file can't be read.
StatusOr<std::vector<CsvRow>> ReadCsvRows(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_CSV_TABLE_H_
