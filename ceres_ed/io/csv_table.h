// Reads tables whose fields are separated by commas.
#ifndef CERES_ED_IO_CSV_TABLE_H_
#define CERES_ED_IO_CSV_TABLE_H_

#include <ceres_ed/util/status.h>

#include <cstddef>
#include <string>
#include <vector>

namespace ceres_ed {

// A line of a table.
struct CsvRow {
  // "frames.csv: line 3: ", the beginning of an error message.
  std::string place;
  // The fields, at least one, without blanks around them. A field may be empty.
  std::vector<std::string> fields;

  // Returns an error unless there are `count` fields.
  Status ExpectFields(std::size_t count) const;
};

// Returns the lines of a file that are not blank and not a comment. Text after # is removed.
// Returns an error if the file can't be read.
StatusOr<std::vector<CsvRow>> ReadCsvRows(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_CSV_TABLE_H_
