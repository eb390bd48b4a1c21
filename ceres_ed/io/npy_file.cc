#include "ceres_ed/io/npy_file.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/text.h>
#include <ceres_ed/util/text.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <system_error>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr std::string_view kMagic("\x93NUMPY", 6);
// Larger arrays are no input of this library.
constexpr std::size_t kMostElements = std::size_t{1} << 31;

// The type and layout that a header describes.
struct Layout {
  // One of f, i, u, b.
  char kind = 'f';
  std::size_t bytes = 0;
  bool is_big_endian = false;
  bool is_fortran = false;
  std::vector<std::size_t> shape;
};

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
Status ParseType(const std::string& path, std::string_view header, Layout* layout) {
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

Status ParseShape(const std::string& path, std::string_view header, Layout* layout) {
  const std::string_view text = ValueOf(header, "shape");
  const std::size_t end = text.find(')');
  if (text.empty() || text[0] != '(' || end == std::string_view::npos) {
    return NotNpy(path, "the header has no shape");
  }
  for (const std::string_view field : SplitWords(text.substr(1, end - 1), ", ")) {
    std::size_t size = 0;
    const auto result = std::from_chars(field.data(), field.data() + field.size(), size);
    if (result.ec != std::errc() || size > kMostElements) {
      return NotNpy(path, "the shape has " + Quoted(field));
    }
    layout->shape.push_back(size);
  }
  layout->is_fortran = ValueOf(header, "fortran_order").rfind("True", 0) == 0;
  return Status::Ok();
}

// Parses the header and returns the place where the numbers begin.
StatusOr<std::size_t> ParseHeader(const std::string& path,
                                  const std::string& bytes,
                                  Layout* layout) {
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
  Status status = ParseType(path, header, layout);
  if (status.ok()) status = ParseShape(path, header, layout);
  if (!status.ok()) return status;
  return begin + length;
}

template <typename T>
double Decode(const char* bytes, bool swap) {
  char ordered[sizeof(T)];
  std::memcpy(ordered, bytes, sizeof(T));
  if (swap) std::reverse(ordered, ordered + sizeof(T));
  T value;
  std::memcpy(&value, ordered, sizeof(T));
  return static_cast<double>(value);
}

double DecodeNumber(const Layout& layout, const char* bytes) {
  const bool swap = layout.is_big_endian;
  switch (layout.kind) {
    case 'f':
      return layout.bytes == 4 ? Decode<float>(bytes, swap) : Decode<double>(bytes, swap);
    case 'i':
      switch (layout.bytes) {
        case 1:
          return Decode<std::int8_t>(bytes, swap);
        case 2:
          return Decode<std::int16_t>(bytes, swap);
        case 4:
          return Decode<std::int32_t>(bytes, swap);
        default:
          return Decode<std::int64_t>(bytes, swap);
      }
    default:
      switch (layout.bytes) {
        case 1:
          return Decode<std::uint8_t>(bytes, swap);
        case 2:
          return Decode<std::uint16_t>(bytes, swap);
        case 4:
          return Decode<std::uint32_t>(bytes, swap);
        default:
          return Decode<std::uint64_t>(bytes, swap);
      }
  }
}

// Returns the place in C order of the element that is `index`-th in Fortran order.
std::size_t PlaceInC(const std::vector<std::size_t>& shape, std::size_t index) {
  std::size_t place = 0;
  std::vector<std::size_t> at(shape.size());
  for (std::size_t axis = 0; axis < shape.size(); ++axis) {
    at[axis] = index % shape[axis];
    index /= shape[axis];
  }
  for (std::size_t axis = 0; axis < shape.size(); ++axis) place = place * shape[axis] + at[axis];
  return place;
}

template <typename T>
Status Write(const std::string& path, const NpyArray& array, const char* type) {
  std::size_t count = 1;
  for (const std::size_t size : array.shape) count *= size;
  CHECK_EQ(count, array.values.size());
  std::string shape = array.ShapeText();
  std::string header =
      std::string("{'descr': '") + type + "', 'fortran_order': False, 'shape': " + shape + ", }";
  // Numbers begin at a multiple of 64 bytes.
  constexpr std::size_t kPrefix = 10;
  while ((kPrefix + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  std::string bytes(kMagic);
  bytes += '\1';
  bytes += '\0';
  bytes += static_cast<char>(header.size() & 0xFFU);
  bytes += static_cast<char>(header.size() >> 8U);
  bytes += header;
  for (const double value : array.values) {
    const T number = static_cast<T>(value);
    char raw[sizeof(T)];
    std::memcpy(raw, &number, sizeof(T));
    bytes.append(raw, sizeof(T));
  }
  return WriteFileAtomically(path, bytes);
}

}  // namespace

std::string NpyArray::ShapeText() const {
  std::string text = "(";
  for (const std::size_t size : shape) text += (text.size() > 1 ? ", " : "") + std::to_string(size);
  return text + (shape.size() == 1 ? ",)" : ")");
}

StatusOr<NpyArray> ReadNpyFile(const std::string& path) {
  const StatusOr<std::string> bytes = ReadWholeFile(path);
  if (!bytes.ok()) return bytes.status();
  Layout layout;
  const StatusOr<std::size_t> begin = ParseHeader(path, *bytes, &layout);
  if (!begin.ok()) return begin.status();
  NpyArray array;
  array.shape = layout.shape;
  std::size_t count = 1;
  for (const std::size_t size : layout.shape) {
    count *= size;
    if (count > kMostElements) return NotNpy(path, "the shape is " + array.ShapeText());
  }
  if (bytes->size() - *begin != count * layout.bytes) {
    return Status::Error(path + ": " + std::to_string(bytes->size() - *begin) +
                         " bytes of numbers, expected " + std::to_string(count * layout.bytes) +
                         " for the shape " + array.ShapeText());
  }
  array.values.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t place = layout.is_fortran ? PlaceInC(layout.shape, i) : i;
    array.values[place] = DecodeNumber(layout, bytes->data() + *begin + i * layout.bytes);
  }
  return array;
}

Status WriteNpyFile(const std::string& path, const NpyArray& array) {
  return Write<double>(path, array, "<f8");
}

Status WriteNpyFileAsFloat(const std::string& path, const NpyArray& array) {
  return Write<float>(path, array, "<f4");
}

}  // namespace ceres_ed
