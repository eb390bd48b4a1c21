#include "ceres_ed/io/npy_file.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/npy_header.h>
#include <ceres_ed/io/text.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr std::size_t kMostElements = std::size_t{1} << 31;

template <typename T>
double Decode(const char* bytes, bool swap) {
  char ordered[sizeof(T)];
  std::memcpy(ordered, bytes, sizeof(T));
  if (swap) std::reverse(ordered, ordered + sizeof(T));
  T value;
  std::memcpy(&value, ordered, sizeof(T));
  return static_cast<double>(value);
}

double DecodeNumber(const NpyHeader& layout, const char* bytes) {
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
  std::string bytes = MakeNpyHeader(type, array.shape);
  for (const double value : array.values) {
    const T number = static_cast<T>(value);
    char raw[sizeof(T)];
    std::memcpy(raw, &number, sizeof(T));
    bytes.append(raw, sizeof(T));
  }
  return WriteFileAtomically(path, bytes);
}

}  // namespace

std::string NpyArray::ShapeText() const { return NpyShapeText(shape); }

StatusOr<NpyArray> ReadNpyFile(const std::string& path) {
  const StatusOr<std::string> bytes = ReadWholeFile(path);
  if (!bytes.ok()) return bytes.status();
  const StatusOr<NpyHeader> layout = ParseNpyHeader(path, *bytes);
  if (!layout.ok()) return layout.status();
  NpyArray array;
  array.shape = layout->shape;
  std::size_t count = 1;
  for (const std::size_t size : layout->shape) {
    count *= size;
    if (count > kMostElements) {
      return Status::Error(path + ": the shape is " + array.ShapeText() +
                           ", expected fewer than 2^31 numbers");
    }
  }
  if (bytes->size() - layout->begin != count * layout->bytes) {
    return Status::Error(path + ": " + std::to_string(bytes->size() - layout->begin) +
                         " bytes of numbers, expected " + std::to_string(count * layout->bytes) +
                         " for the shape " + array.ShapeText());
  }
  array.values.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t place = layout->is_fortran ? PlaceInC(layout->shape, i) : i;
    array.values[place] = DecodeNumber(*layout, bytes->data() + layout->begin + i * layout->bytes);
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
