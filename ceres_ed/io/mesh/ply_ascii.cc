#include "ceres_ed/io/mesh/ply_ascii.h"

#include <ceres_ed/io/text.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace ceres_ed {
namespace {

template <typename T>
bool Fits(double value) {
  return value >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
         value <= static_cast<double>(std::numeric_limits<T>::max()) && value == std::floor(value);
}

// Returns whether an integer type can represent `value` exactly.
bool FitsIntegerType(PlyType type, double value) {
  switch (type) {
    case PlyType::kInt8:
      return Fits<std::int8_t>(value);
    case PlyType::kUint8:
      return Fits<std::uint8_t>(value);
    case PlyType::kInt16:
      return Fits<std::int16_t>(value);
    case PlyType::kUint16:
      return Fits<std::uint16_t>(value);
    case PlyType::kInt32:
      return Fits<std::int32_t>(value);
    case PlyType::kUint32:
      return Fits<std::uint32_t>(value);
    case PlyType::kFloat32:
    case PlyType::kFloat64:
      return false;
  }
  return false;
}

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

// Reads the lines of a text and the words of a line.
class Scanner {
 public:
  // `line_ends` is as in PlyHeader; `line_number` is the number of lines before the text.
  Scanner(std::string_view text, std::string_view line_ends, int line_number)
      : rest_(text), line_ends_(line_ends), line_number_(line_number) {}

  // Moves to the next line that has words. Returns false at the end of the text.
  bool NextLine() {
    while (!rest_.empty()) {
      const std::size_t length = std::min(FindLineEnd(), rest_.size());
      line_ = rest_.substr(0, length);
      rest_.remove_prefix(std::min(length + 1, rest_.size()));
      ++line_number_;
      SkipBlanks();
      if (!line_.empty()) return true;
    }
    return false;
  }

  // Returns the next word of the line; empty at its end.
  std::string_view NextWord() {
    std::size_t length = 0;
    while (length < line_.size() && !IsBlank(line_[length])) ++length;
    const std::string_view word = line_.substr(0, length);
    line_.remove_prefix(length);
    SkipBlanks();
    return word;
  }

  int line_number() const { return line_number_; }
  std::size_t bytes_left() const { return rest_.size(); }
  std::string_view rest_of_line() const { return line_; }

 private:
  // A search for a single character is several times faster.
  std::size_t FindLineEnd() const {
    return line_ends_.size() == 1 ? rest_.find(line_ends_[0]) : rest_.find_first_of(line_ends_);
  }

  void SkipBlanks() {
    while (!line_.empty() && IsBlank(line_.front())) line_.remove_prefix(1);
  }

  std::string_view rest_;
  std::string_view line_ends_;
  std::string_view line_;
  int line_number_;
};

class AsciiBodyReader {
 public:
  AsciiBodyReader(const std::string& path, std::string_view body, const PlyHeader& header)
      : path_(path), scanner_(body, header.line_ends, header.num_lines) {}

  Status Read(PlyElement* element) {
    for (PlyProperty& property : element->properties) {
      // Each value takes at least two bytes. Memory for more rows than the file can have is not
      // reserved.
      const std::size_t rows = std::min(element->count, scanner_.bytes_left() / 2 + 1);
      (property.is_list ? property.list_sizes.reserve(rows) : property.values.reserve(rows));
    }
    for (std::size_t row = 0; row < element->count; ++row) {
      if (!scanner_.NextLine()) {
        return Status::Error(path_ + ": truncated: element '" + element->name + "' promises " +
                             std::to_string(element->count) + " rows, the file ends in row " +
                             std::to_string(row));
      }
      for (PlyProperty& property : element->properties) {
        Status status = property.is_list ? ReadList(*element, row, &property)
                                         : ReadValue(*element, row, &property);
        if (!status.ok()) return status;
      }
      if (!scanner_.rest_of_line().empty()) {
        return Error(*element,
                     row,
                     "unexpected " + Quoted(scanner_.rest_of_line()) +
                         " behind the last property '" + element->properties.back().name + "'");
      }
    }
    return Status::Ok();
  }

 private:
  Status ReadValue(const PlyElement& element, std::size_t row, PlyProperty* property) {
    const std::string_view word = scanner_.NextWord();
    const std::optional<double> value = ParsePlyNumber(word, property->type);
    if (!value.has_value()) return ValueError(element, row, *property, word, property->type);
    property->values.push_back(*value);
    return Status::Ok();
  }

  Status ReadList(const PlyElement& element, std::size_t row, PlyProperty* property) {
    const std::string_view word = scanner_.NextWord();
    const std::optional<double> size = ParsePlyNumber(word, property->list_count_type);
    if (!size.has_value() || *size < 0.0) {
      return Error(element,
                   row,
                   "the list '" + property->name + "' has the length " + Quoted(word) +
                       ", expected a whole number of at least 0 that fits its type");
    }
    const auto list_size = static_cast<std::uint32_t>(*size);
    for (std::uint32_t i = 0; i < list_size; ++i) {
      Status status = ReadValue(element, row, property);
      if (!status.ok()) return status;
    }
    property->list_sizes.push_back(list_size);
    return Status::Ok();
  }

  Status ValueError(const PlyElement& element,
                    std::size_t row,
                    const PlyProperty& property,
                    std::string_view word,
                    PlyType type) const {
    if (word.empty()) {
      // The likely cause is a file that was cut off.
      const std::string truncated = scanner_.bytes_left() == 0 ? " (truncated?)" : "";
      return Error(
          element, row, "the line ends ahead of property '" + property.name + "'" + truncated);
    }
    return Error(element,
                 row,
                 "property '" + property.name + "' is " + Quoted(word) + ", expected " +
                     (IsFloatingPlyType(type) ? "a number" : "a whole number that fits its type"));
  }

  Status Error(const PlyElement& element, std::size_t row, const std::string& what) const {
    return Status::Error(path_ + ": line " + std::to_string(scanner_.line_number()) + ": row " +
                         std::to_string(row) + " of element '" + element.name + "': " + what);
  }

  const std::string& path_;
  Scanner scanner_;
};

}  // namespace

std::optional<double> ParsePlyNumber(std::string_view word, PlyType type) {
  const std::optional<double> value = ParseDouble(word);
  if (!value.has_value() || type == PlyType::kFloat64) return value;
  if (type == PlyType::kFloat32) return static_cast<double>(static_cast<float>(*value));
  return FitsIntegerType(type, *value) ? value : std::nullopt;
}

Status ReadPlyAsciiBody(const std::string& path, std::string_view body, PlyHeader* header) {
  AsciiBodyReader reader(path, body, *header);
  for (PlyElement& element : header->document.elements) {
    Status status = reader.Read(&element);
    if (!status.ok()) return status;
  }
  return Status::Ok();
}

}  // namespace ceres_ed
