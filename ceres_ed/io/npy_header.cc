#include "ceres_ed/io/npy_header.h"

#include <ceres_ed/io/text.h>
#include <ceres_ed/util/text.h>

#include <charconv>
#include <string_view>
#include <system_error>

namespace ceres_ed {
namespace {

constexpr std::string_view kMagic("\x93NUMPY", 6);
Status NotNpy(const std::string& path, const std::string& why) {
  return Status::Error(path + ": " + why + ", expected an array that numpy.save has written");
}

// Returns the text that follows 'key': in the header, which is a dictionary of Python.
std::string_view ValueOf(std::string_view header, std::string_view key) {
  const std::size_t at = header.find("'" + std::string(key) + "'");
  if (at == std::string_view::npos) return {};
  const std::size_t colon = header.find(':', at);
  return colon == std::string_view::npos ? std::string_view() : Trim(header.substr(colon + 1));
}

// Parses a type such as '<f4'.
Status ParseType(const std::string& path, std::string_view header, NpyHeader* layout) {
  const std::string_view text = ValueOf(header, "descr");
  const std::size_t end = text.size() < 2 ? std::string_view::npos : text.find('\'', 1);
  if (end == std::string_view::npos || text[0] != '\'') {
    return NotNpy(path, "the header names no type of a number");
  }
  const std::string_view type = text.substr(1, end - 1);
  const bool is_known = type.size() == 3 &&
                        std::string_view("<>|=").find(type[0]) != std::string_view::npos &&
                        std::string_view("fiub").find(type[1]) != std::string_view::npos &&
                        std::string_view("1248").find(type[2]) != std::string_view::npos &&
                        (type[1] != 'f' || type[2] >= '4');
  if (!is_known) {
    return Status::Error(path + ": the type is " + Quoted(type) +
                         ", expected floats of 32 or 64 bits or integers");
  }
  layout->is_big_endian = type[0] == '>';
  layout->kind = type[1];
  layout->bytes = static_cast<std::size_t>(type[2] - '0');
  return Status::Ok();
}

Status ParseShape(const std::string& path, std::string_view header, NpyHeader* layout) {
  const std::string_view text = ValueOf(header, "shape");
  const std::size_t end = text.find(')');
  if (text.empty() || text[0] != '(' || end == std::string_view::npos) {
    return NotNpy(path, "the header has no shape");
  }
  for (const std::string_view field : SplitWords(text.substr(1, end - 1), ", ")) {
    std::size_t size = 0;
    const auto result = std::from_chars(field.data(), field.data() + field.size(), size);
    if (result.ec != std::errc() || size > kMostNpyElements) {
      return NotNpy(path, "the shape has " + Quoted(field));
    }
    layout->shape.push_back(size);
  }
  layout->is_fortran = ValueOf(header, "fortran_order").rfind("True", 0) == 0;
  return Status::Ok();
}

}  // namespace

StatusOr<NpyHeader> ParseNpyHeader(const std::string& path, const std::string& bytes) {
  if (bytes.size() < 12 || std::string_view(bytes).substr(0, kMagic.size()) != kMagic) {
    return NotNpy(path, "the file does not begin with the mark of numpy");
  }
  const auto byte = [&bytes](std::size_t i) {
    return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i]));
  };
  const bool is_short = bytes[6] == 1;
  const std::size_t length =
      is_short ? byte(8) + (byte(9) << 8U)
               : byte(8) + (byte(9) << 8U) + (byte(10) << 16U) + (byte(11) << 24U);
  const std::size_t begin = is_short ? 10 : 12;
  if (length > bytes.size() - begin) return NotNpy(path, "the header is cut off");
  const std::string_view header = std::string_view(bytes).substr(begin, length);
  NpyHeader layout;
  Status status = ParseType(path, header, &layout);
  if (status.ok()) status = ParseShape(path, header, &layout);
  if (!status.ok()) return status;
  layout.begin = begin + length;
  return layout;
}

std::string NpyShapeText(const std::vector<std::size_t>& shape) {
  std::string text = "(";
  for (const std::size_t size : shape) text += (text.size() > 1 ? ", " : "") + std::to_string(size);
  return text + (shape.size() == 1 ? ",)" : ")");
}

std::string MakeNpyHeader(const char* type, const std::vector<std::size_t>& shape) {
  std::string header = std::string("{'descr': '") + type +
                       "', 'fortran_order': False, 'shape': " + NpyShapeText(shape) + ", }";
  // Numbers begin at a multiple of 64 bytes.
  constexpr std::size_t kPrefix = 10;
  while ((kPrefix + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  std::string bytes(kMagic);
  bytes += '\1';
  bytes += '\0';
  bytes += static_cast<char>(header.size() & 0xFFU);
  bytes += static_cast<char>(header.size() >> 8U);
  return bytes + header;
}

}  // namespace ceres_ed
