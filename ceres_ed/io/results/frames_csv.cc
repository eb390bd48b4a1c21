#include "ceres_ed/io/results/frames_csv.h"

#include <ceres_ed/io/csv_table.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/io/text_rows.h>
#include <ceres_ed/util/shown_text.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// Returns the value of a cell; NaN if it is empty.
StatusOr<double> ParseCell(const CsvRow& row, const std::string& name, const std::string& cell) {
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  const std::optional<double> value = ParseDouble(cell);
  if (value) return *value;
  return Status::Error(row.place + ShownLine(name) + " is " + Quoted(cell) + ", expected a number");
}

}  // namespace

double& FrameRecord::operator[](const std::string& column) {
  const auto found = std::find(kFrameColumns.begin(), kFrameColumns.end(), column);
  CHECK(found != kFrameColumns.end()) << "no column " << column;
  return values[static_cast<std::size_t>(found - kFrameColumns.begin())];
}

std::string FramesHeader() {
  std::string header = "frame,status";
  for (const char* column : kFrameColumns) header += std::string(",") + column;
  return header + "\n";
}

std::string FramesRow(const FrameRecord& record) {
  std::string row = std::to_string(record.number) + "," + record.status;
  for (std::size_t i = 0; i < kFrameColumns.size(); ++i) {
    const bool is_time = kFrameColumns[i][0] == 't' && kFrameColumns[i][1] == '_';
    // Clocks are not more accurate than microseconds.
    const double value = is_time ? std::round(record.values[i] * 1e6) / 1e6 : record.values[i];
    std::string text;
    if (!std::isnan(value)) AppendNumbers({value}, &text);
    row += "," + text;
  }
  return row + "\n";
}

const std::vector<double>* FrameLog::Find(const std::string& name) const {
  for (const auto& [column, values] : columns) {
    if (column == name) return &values;
  }
  return nullptr;
}

StatusOr<FrameLog> ReadFrameLog(const std::string& path) {
  const StatusOr<std::vector<CsvRow>> rows = ReadCsvRows(path);
  if (!rows.ok()) return rows.status();
  const std::vector<std::string> header =
      rows->empty() ? std::vector<std::string>() : (*rows)[0].fields;
  const auto column_of = [&header](const char* name) {
    return static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
  };
  const std::size_t frame_column = column_of("frame");
  const std::size_t status_column = column_of("status");
  if (std::max(frame_column, status_column) >= header.size()) {
    return Status::Error(path + ": no columns 'frame' and 'status', expected a header with both");
  }
  FrameLog log;
  for (const std::string& name : header) log.columns.push_back({name, {}});
  for (std::size_t r = 1; r < rows->size(); ++r) {
    const CsvRow& row = (*rows)[r];
    Status status = row.ExpectFields(header.size());
    if (!status.ok()) return status;
    const StatusOr<int> frame = ParseNatural(row.place, "frame", row.fields[frame_column]);
    if (!frame.ok()) return frame.status();
    log.frames.push_back(*frame);
    log.statuses.push_back(row.fields[status_column]);
    for (std::size_t c = 0; c < header.size(); ++c) {
      if (c == frame_column || c == status_column) continue;
      const StatusOr<double> value = ParseCell(row, header[c], row.fields[c]);
      if (!value.ok()) return value.status();
      log.columns[c].second.push_back(*value);
    }
  }
  // The higher one is erased first, so that the index of the other one stays the same.
  log.columns.erase(log.columns.begin() + std::max(frame_column, status_column));
  log.columns.erase(log.columns.begin() + std::min(frame_column, status_column));
  return log;
}

}  // namespace ceres_ed
