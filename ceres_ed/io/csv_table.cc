#include "ceres_ed/io/csv_table.h"

#include <ceres_ed/io/text.h>
#include <ceres_ed/util/text.h>

#include <string_view>
#include <utility>

namespace ceres_ed {

Status CsvRow::ExpectFields(std::size_t count) const {
  if (fields.size() == count) return Status::Ok();
  return Status::Error(place + std::to_string(fields.size()) + " fields, expected " +
                       std::to_string(count));
}

StatusOr<std::vector<CsvRow>> ReadCsvRows(const std::string& path) {
  const StatusOr<std::string> contents = ReadWholeFile(path);
  if (!contents.ok()) return contents.status();
  std::vector<CsvRow> rows;
  int number = 0;
  for (const std::string_view whole : SplitLines(*contents, '\n')) {
    ++number;
    const std::string_view line = Trim(whole.substr(0, whole.find('#')));
    if (line.empty()) continue;
    CsvRow row{path + ": line " + std::to_string(number) + ": ", {}};
    for (const std::string_view field : SplitFields(line, ','))
      row.fields.emplace_back(Trim(field));
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace ceres_ed
