#include "ceres_ed/io/mesh/ply_header.h"

#include <ceres_ed/io/mesh/mesh_view.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/util/text.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace ceres_ed {
namespace {

struct TypeName {
  const char* name;
  PlyType type;
};
// The first name of each type is used for writing.
constexpr TypeName kTypeNames[] = {
    {"char", PlyType::kInt8},
    {"uchar", PlyType::kUint8},
    {"short", PlyType::kInt16},
    {"ushort", PlyType::kUint16},
    {"int", PlyType::kInt32},
    {"uint", PlyType::kUint32},
    {"float", PlyType::kFloat32},
    {"double", PlyType::kFloat64},
    {"int8", PlyType::kInt8},
    {"uint8", PlyType::kUint8},
    {"int16", PlyType::kInt16},
    {"uint16", PlyType::kUint16},
    {"int32", PlyType::kInt32},
    {"uint32", PlyType::kUint32},
    {"float32", PlyType::kFloat32},
    {"float64", PlyType::kFloat64},
};
struct FormatName {
  const char* name;
  PlyFormat format;
};
constexpr FormatName kFormatNames[] = {
    {"ascii", PlyFormat::kAscii},
    {"binary_little_endian", PlyFormat::kBinaryLittleEndian},
    {"binary_big_endian", PlyFormat::kBinaryBigEndian},
};

const char* NameOf(PlyType type) {
  for (const TypeName& entry : kTypeNames) {
    if (entry.type == type) return entry.name;
  }
  return "";
}

const char* NameOf(PlyFormat format) {
  for (const FormatName& entry : kFormatNames) {
    if (entry.format == format) return entry.name;
  }
  return "";
}

std::optional<PlyType> TypeOf(std::string_view name) {
  for (const TypeName& entry : kTypeNames) {
    if (name == entry.name) return entry.type;
  }
  return std::nullopt;
}

// Returns the text after the keyword and one blank, including trailing blanks.
std::string TextBehind(std::string_view line, std::string_view keyword) {
  const std::size_t begin =
      static_cast<std::size_t>(keyword.data() - line.data()) + keyword.size() + 1;
  return begin < line.size() ? std::string(line.substr(begin)) : std::string();
}

// Control characters are not allowed in names, since some readers take them for blanks and others
// for letters.
bool IsPrintable(std::string_view name) {
  return std::none_of(
      name.begin(), name.end(), [](char c) { return (c >= '\0' && c < ' ') || c == '\x7f'; });
}

// Some editors write it at the start of a text.
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

// Returns what ends the lines of `text`, according to the end of the first line.
std::string_view LineEnds(std::string_view text) {
  const std::size_t end = text.find_first_of(PlyHeader::kCarriageReturnOrLineFeed);
  const bool carriage_return_alone =
      end != std::string_view::npos && text[end] == '\r' && text.substr(end + 1, 1) != "\n";
  return carriage_return_alone ? PlyHeader::kCarriageReturnOrLineFeed : PlyHeader::kLineFeed;
}

// Reads the lines of a header into a document, one after the other.
class HeaderParser {
 public:
  explicit HeaderParser(std::string path) : path_(std::move(path)) {}

  StatusOr<PlyHeader> Parse(std::string_view text) {
    if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
      header_.size = kByteOrderMark.size();
    }
    header_.line_ends = LineEnds(text);
    while (true) {
      const std::size_t line_end = text.find_first_of(header_.line_ends, header_.size);
      if (line_end == std::string_view::npos) return NoEndError(text.substr(header_.size));
      std::string_view line = text.substr(header_.size, line_end - header_.size);
      if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
      header_.size = line_end + 1;
      ++header_.num_lines;

      const std::vector<std::string_view> words = SplitWords(line, " \t");
      if (header_.num_lines == 1) {
        if (words.size() != 1 || words[0] != "ply") return NotPlyError();
        continue;
      }
      if (words.empty()) continue;
      if (words[0] == "end_header") break;
      Status status = ParseLine(line, words);
      if (!status.ok()) return status;
    }
    Status status = CheckComplete();
    if (!status.ok()) return status;
    return std::move(header_);
  }

 private:
  Status ParseLine(std::string_view line, const std::vector<std::string_view>& words) {
    PlyDocument& document = header_.document;
    if (words[0] == "comment") {
      document.comments.push_back(TextBehind(line, words[0]));
      return Status::Ok();
    }
    if (words[0] == "obj_info") {
      document.obj_info.push_back(TextBehind(line, words[0]));
      return Status::Ok();
    }
    if (words[0] == "format") return ParseFormat(words);
    if (words[0] == "element") return ParseElement(words);
    if (words[0] == "property") return ParseProperty(words);
    return Error("unknown keyword " + Quoted(words[0]) +
                 ", expected format, comment, obj_info, element, property or end_header");
  }

  Status ParseFormat(const std::vector<std::string_view>& words) {
    if (has_format_) return Error("a second format line, expected one");
    if (words.size() == 3 && words[2] == "1.0") {
      for (const FormatName& entry : kFormatNames) {
        if (words[1] != entry.name) continue;
        header_.document.format = entry.format;
        has_format_ = true;
        return Status::Ok();
      }
    }
    return Error(
        "unknown format, expected 'format' and ascii, binary_little_endian or "
        "binary_big_endian, then 1.0");
  }

  Status ParseElement(const std::vector<std::string_view>& words) {
    if (words.size() != 3) return Error("expected 'element NAME COUNT'");
    if (!IsPrintable(words[1])) return Error(Quoted(words[1]) + " is no name of an element");
    std::uint64_t count = 0;
    const char* const end = words[2].data() + words[2].size();
    const std::from_chars_result result = std::from_chars(words[2].data(), end, count);
    if (result.ec != std::errc() || result.ptr != end) {
      return Error("element '" + std::string(words[1]) + "' has the count " + Quoted(words[2]) +
                   ", expected a whole number of at least 0");
    }
    PlyElement element;
    element.name = std::string(words[1]);
    element.count = count;
    if (header_.document.Find(element.name) != nullptr) {
      return Error("a second element '" + element.name + "', expected one");
    }
    header_.document.elements.push_back(std::move(element));
    return Status::Ok();
  }

  Status ParseProperty(const std::vector<std::string_view>& words) {
    if (header_.document.elements.empty()) return Error("a property ahead of the first element");
    const bool is_list = words.size() >= 2 && words[1] == "list";
    if (words.size() != (is_list ? 5u : 3u)) {
      return Error("expected 'property TYPE NAME' or 'property list COUNT_TYPE TYPE NAME'");
    }
    PlyProperty property;
    property.is_list = is_list;
    property.name = std::string(words.back());
    if (!IsPrintable(property.name)) {
      return Error(Quoted(property.name) + " is no name of a property");
    }
    const std::string_view type_name = words[words.size() - 2];
    const std::optional<PlyType> type = TypeOf(type_name);
    if (!type.has_value()) {
      return Error("property '" + property.name + "' has the unknown type " + Quoted(type_name) +
                   ", expected char, uchar, short, ushort, int, uint, "
                   "float or double");
    }
    property.type = *type;
    if (is_list) {
      const std::optional<PlyType> count_type = TypeOf(words[2]);
      if (!count_type.has_value() || IsFloatingPlyType(*count_type)) {
        return Error("the lists of property '" + property.name + "' have the count type " +
                     Quoted(words[2]) + ", expected an integer type");
      }
      property.list_count_type = *count_type;
    }
    PlyElement& element = header_.document.elements.back();
    if (element.Find(property.name) != nullptr) {
      return Error("a second property '" + property.name + "' of element '" + element.name +
                   "', expected one");
    }
    element.properties.push_back(std::move(property));
    return Status::Ok();
  }

  Status CheckComplete() const {
    if (!has_format_) return Status::Error(path_ + ": the header has no format line");
    for (const PlyElement& element : header_.document.elements) {
      // Such rows take no bytes, so no file could show that a count of 4e9 is wrong.
      if (element.properties.empty() && element.count > 0) {
        return Status::Error(path_ + ": element '" + element.name + "' has " +
                             std::to_string(element.count) + " rows but no properties");
      }
    }
    return Status::Ok();
  }

  Status Error(const std::string& what) const {
    return Status::Error(path_ + ": line " + std::to_string(header_.num_lines) + ": " + what);
  }

  Status NotPlyError() const {
    return Status::Error(path_ + ": not a PLY file: the first line is not 'ply'");
  }

  Status NoEndError(std::string_view rest) const {
    if (header_.num_lines > 0) {
      return Status::Error(path_ + ": truncated: the header has no line 'end_header'");
    }
    if (rest == "ply") return Status::Error(path_ + ": truncated: nothing behind the line 'ply'");
    return NotPlyError();
  }

  std::string path_;
  PlyHeader header_;
  bool has_format_ = false;
};

}  // namespace

StatusOr<PlyHeader> ParsePlyHeader(const std::string& path, std::string_view text) {
  return HeaderParser(path).Parse(text);
}

std::string FormatPlyHeader(const PlyDocument& document) {
  std::string text = "ply\nformat " + std::string(NameOf(document.format)) + " 1.0\n";
  const auto append_lines = [&text](const char* keyword, const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
      text += keyword;
      if (!line.empty()) text += ' ' + CommentLine(line);
      text += '\n';
    }
  };
  append_lines("comment", document.comments);
  append_lines("obj_info", document.obj_info);
  for (const PlyElement& element : document.elements) {
    text += "element " + element.name + ' ' + std::to_string(element.count) + '\n';
    for (const PlyProperty& property : element.properties) {
      text += "property ";
      if (property.is_list) text += std::string("list ") + NameOf(property.list_count_type) + ' ';
      text += std::string(NameOf(property.type)) + ' ' + property.name + '\n';
    }
  }
  return text + "end_header\n";
}

}  // namespace ceres_ed
