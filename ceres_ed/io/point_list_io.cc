#include "ceres_ed/io/point_list_io.h"

#include <ceres_ed/io/text.h>
#include <ceres_ed/io/text_rows.h>
#include <ceres_ed/util/text.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>

namespace ceres_ed {
namespace {

constexpr std::string_view kHeader[] = {"source_index", "x", "y", "z"};

std::vector<std::string_view> TrimmedFields(std::string_view line) {
  std::vector<std::string_view> fields = SplitFields(line, ',');
  for (std::string_view& field : fields) field = Trim(field);
  return fields;
}

std::string Place(const std::string& path, int line_number) {
  return path + ": line " + std::to_string(line_number) + ": ";
}

StatusOr<int> ParseIndex(const std::string& place, std::string_view text, int num_vertices) {
  long long index = 0;
  const char* const end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, index);
  if (result.ptr != end || result.ec == std::errc::invalid_argument) {
    return Status::Error(place + Quoted(text) + " is no vertex index, expected a whole number");
  }
  if (result.ec != std::errc() || index < 0 || index >= num_vertices) {
    return Status::Error(place + "vertex " + std::string(text) +
                         " is out of range, expected 0 to " + std::to_string(num_vertices - 1));
  }
  return static_cast<int>(index);
}

StatusOr<Landmark> ParseLandmark(const std::string& place,
                                 std::string_view line,
                                 int num_vertices) {
  const std::vector<std::string_view> fields = TrimmedFields(line);
  if (fields.size() != 4) {
    return Status::Error(place + std::to_string(fields.size()) +
                         (fields.size() == 1 ? " field" : " fields") +
                         ", expected 4: source_index,x,y,z");
  }
  const StatusOr<int> index = ParseIndex(place, fields[0], num_vertices);
  if (!index.ok()) return index.status();
  Landmark landmark;
  landmark.point = *index;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::optional<double> value = ParseDouble(fields[axis + 1]);
    if (!value.has_value() || !std::isfinite(*value)) {
      return Status::Error(place + std::string(kHeader[axis + 1]) + " is " +
                           Quoted(fields[axis + 1]) + ", expected a finite number");
    }
    landmark.position[static_cast<Eigen::Index>(axis)] = *value;
  }
  return landmark;
}

// Returns whether the row is a header. A header with other columns is an error.
StatusOr<bool> IsHeader(const std::string& place, std::string_view line) {
  const std::vector<std::string_view> fields = TrimmedFields(line);
  const bool has_number = std::any_of(fields.begin(), fields.end(), [](std::string_view field) {
    return ParseDouble(field).has_value();
  });
  if (has_number) return false;
  if (!std::equal(fields.begin(), fields.end(), std::begin(kHeader), std::end(kHeader))) {
    return Status::Error(place + "the row is " + Quoted(line) +
                         ", expected numbers or the header source_index,x,y,z");
  }
  return true;
}

}  // namespace

StatusOr<std::vector<Landmark>> ReadLandmarks(const std::string& path, int num_vertices) {
  std::vector<Landmark> landmarks;
  struct Seen {
    Eigen::Vector3d position;
    int line_number;
  };
  std::map<int, Seen> seen;
  bool is_first = true;
  Status status = ForEachTextLine(path, [&](std::string_view line, int line_number) {
    const std::string place = Place(path, line_number);
    if (is_first) {
      is_first = false;
      const StatusOr<bool> is_header = IsHeader(place, line);
      if (!is_header.ok()) return is_header.status();
      if (*is_header) return Status::Ok();
    }
    const StatusOr<Landmark> landmark = ParseLandmark(place, line, num_vertices);
    if (!landmark.ok()) return landmark.status();
    const auto [entry, is_new] =
        seen.insert({landmark->point, Seen{landmark->position, line_number}});
    if (is_new) {
      landmarks.push_back(*landmark);
    } else if (entry->second.position != landmark->position) {
      return Status::Error(place + "vertex " + std::to_string(landmark->point) +
                           " has another position than in line " +
                           std::to_string(entry->second.line_number) + ", expected one");
    }
    return Status::Ok();
  });
  if (!status.ok()) return status;
  if (landmarks.empty()) return Status::Error(path + ": no landmarks, expected at least one");
  return landmarks;
}

StatusOr<std::vector<int>> ReadVertexList(const std::string& path, int num_vertices) {
  std::vector<int> indices;
  Status status = ForEachTextLine(path, [&](std::string_view line, int line_number) {
    for (const std::string_view word : SplitWords(line, kFieldSeparators)) {
      const StatusOr<int> index = ParseIndex(Place(path, line_number), word, num_vertices);
      if (!index.ok()) return index.status();
      indices.push_back(*index);
    }
    return Status::Ok();
  });
  if (!status.ok()) return status;
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  return indices;
}

}  // namespace ceres_ed
