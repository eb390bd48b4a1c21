#include "apps/eval_table_file.h"

#include <ceres_ed/io/text.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <string_view>

namespace ceres_ed {
namespace {

constexpr std::string_view kBlanks = " \t\r";

struct Row {
  // "frames.csv: line 3: "
  std::string place;
  std::vector<std::string> fields;
};

std::string_view Trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

// Every line that says something, without its comment.
StatusOr<std::vector<Row>> ReadRows(const std::string& path) {
  const StatusOr<std::string> contents = ReadWholeFile(path);
  if (!contents.ok()) return contents.status();
  std::vector<Row> rows;
  std::string_view rest = *contents;
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t length = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, length);
    rest.remove_prefix(std::min(length + 1, rest.size()));
    line = Trim(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    Row row{path + ": line " + std::to_string(number) + ": ", {}};
    while (true) {
      const std::size_t comma = line.find(',');
      row.fields.emplace_back(Trim(line.substr(0, comma)));
      if (comma == std::string_view::npos) break;
      line.remove_prefix(comma + 1);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

Status CheckFieldCount(const Row& row, std::size_t expected) {
  if (row.fields.size() == expected) return Status::Ok();
  return Status::Error(row.place + std::to_string(row.fields.size()) + " fields, expected " +
                       std::to_string(expected));
}

StatusOr<int> WholeNumber(const Row& row, std::size_t field, const std::string& name) {
  const std::optional<double> value = ParseDouble(row.fields[field]);
  if (!value || *value < 0.0 || *value > std::numeric_limits<int>::max() ||
      *value != std::floor(*value)) {
    return Status::Error(row.place + name + " is " + Quoted(row.fields[field]) +
                         ", expected a whole number >= 0");
  }
  return static_cast<int>(*value);
}

}  // namespace

const std::vector<double>* FrameLog::Find(const std::string& name) const {
  for (const auto& [column, values] : columns) {
    if (column == name) return &values;
  }
  return nullptr;
}

StatusOr<FrameLog> ReadFrameLog(const std::string& path) {
  const StatusOr<std::vector<Row>> rows = ReadRows(path);
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
    const Row& row = (*rows)[r];
    Status status = CheckFieldCount(row, header.size());
    if (!status.ok()) return status;
    const StatusOr<int> frame = WholeNumber(row, frame_column, "frame");
    if (!frame.ok()) return frame.status();
    log.frames.push_back(*frame);
    log.statuses.push_back(row.fields[status_column]);
    for (std::size_t c = 0; c < header.size(); ++c) {
      if (c == frame_column || c == status_column) continue;
      const std::string& field = row.fields[c];
      const std::optional<double> value = ParseDouble(field);
      if (!value && !field.empty()) {
        return Status::Error(row.place + header[c] + " is " + Quoted(field) +
                             ", expected a number");
      }
      log.columns[c].second.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
  }
  // The higher one first: erasing it leaves the other where it is.
  log.columns.erase(log.columns.begin() + std::max(frame_column, status_column));
  log.columns.erase(log.columns.begin() + std::min(frame_column, status_column));
  return log;
}

LogSummary SummarizeLog(const FrameLog& log) {
  LogSummary summary;
  for (const std::string& status : log.statuses) ++summary.frames_by_status[status];
  const std::vector<double>* const inliers = log.Find("inliers");
  for (const auto& [name, values] : log.columns) {
    const bool is_rms = name == "rms_plane";
    std::vector<std::optional<double>> present;
    for (std::size_t r = 0; r < values.size(); ++r) {
      if (is_rms && inliers != nullptr && (*inliers)[r] == 0.0) continue;
      if (std::isfinite(values[r])) present.emplace_back(values[r]);
    }
    if (present.empty()) continue;
    if (is_rms) {
      summary.rms_plane = SummarizeFrames(present);
      summary.rms_plane_last = *present.back();
    } else if (name.rfind("t_", 0) == 0) {
      summary.median_times_s.push_back({name, SummarizeFrames(present).median});
    } else if (name == "nodes" || name == "pr" || name == "map_points") {
      summary.at_the_end.push_back({name, *present.back()});
    }
  }
  return summary;
}

StatusOr<std::vector<TrackObservation>> ReadPictureTracks(const std::string& path) {
  const StatusOr<std::vector<Row>> rows = ReadRows(path);
  if (!rows.ok()) return rows.status();
  std::vector<TrackObservation> observations;
  std::set<std::pair<int, int>> seen;
  for (const Row& row : *rows) {
    Status status = CheckFieldCount(row, 4);
    if (!status.ok()) return status;
    const bool is_first = &row == &rows->front();
    if (is_first && row.fields == std::vector<std::string>{"frame", "track", "u", "v"}) continue;
    const StatusOr<int> frame = WholeNumber(row, 0, "frame");
    if (!frame.ok()) return frame.status();
    const StatusOr<int> track = WholeNumber(row, 1, "track");
    if (!track.ok()) return track.status();
    if (!seen.insert({*frame, *track}).second) {
      return Status::Error(row.place + "track " + row.fields[1] + " is there twice in frame " +
                           row.fields[0] + ", expected it once");
    }
    TrackObservation observation{*frame, *track};
    for (const int axis : {0, 1}) {
      const std::string& field = row.fields[2 + axis];
      const std::optional<double> value = ParseDouble(field);
      if (!value || !std::isfinite(*value)) {
        return Status::Error(row.place + (axis == 0 ? "u" : "v") + " is " + Quoted(field) +
                             ", expected a finite number of pixels");
      }
      observation.pixel[axis] = *value;
    }
    observations.push_back(observation);
  }
  return observations;
}

}  // namespace ceres_ed
