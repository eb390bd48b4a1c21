#include "ceres_ed/io/mesh/ply_writer.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/mesh/byte_order.h>
#include <ceres_ed/io/mesh/ply_header.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <type_traits>
#include <vector>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// The number of bytes that are collected before they are written to the stream.
constexpr std::size_t kChunkSize = 1 << 16;

template <typename T>
T Narrow(double value) {
  if constexpr (std::is_integral_v<T>) {
    CHECK(value >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
          value <= static_cast<double>(std::numeric_limits<T>::max()))
        << value << " does not fit the type of its PLY property";
  }
  return static_cast<T>(value);
}

// Calls `append` with `value` as the C++ type of `type`.
template <typename Append>
void Dispatch(PlyType type, double value, const Append& append) {
  switch (type) {
    case PlyType::kInt8:
      return append(Narrow<std::int8_t>(value));
    case PlyType::kUint8:
      return append(Narrow<std::uint8_t>(value));
    case PlyType::kInt16:
      return append(Narrow<std::int16_t>(value));
    case PlyType::kUint16:
      return append(Narrow<std::uint16_t>(value));
    case PlyType::kInt32:
      return append(Narrow<std::int32_t>(value));
    case PlyType::kUint32:
      return append(Narrow<std::uint32_t>(value));
    case PlyType::kFloat32:
      return append(Narrow<float>(value));
    case PlyType::kFloat64:
      return append(value);
  }
}

class BodyWriter {
 public:
  BodyWriter(PlyFormat format, std::ostream* stream)
      : ascii_(format == PlyFormat::kAscii),
        swap_((format == PlyFormat::kBinaryLittleEndian) != HostIsLittleEndian()),
        stream_(stream) {}

  void Write(const PlyElement& element) {
    // The start of the next list of each property.
    std::vector<std::size_t> list_begins(element.properties.size(), 0);
    for (std::size_t row = 0; row < element.count; ++row) {
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        if (property.is_list) {
          WriteList(property, row, &list_begins[i]);
        } else {
          Append(property.type, property.values[row]);
        }
      }
      if (ascii_) EndLine();
      if (chunk_.size() >= kChunkSize) Flush();
    }
    Flush();
  }

 private:
  void WriteList(const PlyProperty& property, std::size_t row, std::size_t* begin) {
    const std::uint32_t size = property.list_sizes[row];
    Append(property.list_count_type, size);
    for (std::uint32_t i = 0; i < size; ++i) Append(property.type, property.values[*begin + i]);
    *begin += size;
  }

  void Append(PlyType type, double value) {
    Dispatch(type, value, [this](auto typed) { ascii_ ? AppendText(typed) : AppendBytes(typed); });
  }

  template <typename T>
  void AppendText(T value) {
    char text[40];
    const std::to_chars_result result = std::to_chars(text, text + sizeof(text), value);
    chunk_.append(text, result.ptr);
    chunk_ += ' ';
  }

  template <typename T>
  void AppendBytes(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (swap_) std::reverse(bytes, bytes + sizeof(T));
    chunk_.append(bytes, sizeof(T));
  }

  void EndLine() {
    if (!chunk_.empty() && chunk_.back() == ' ') chunk_.pop_back();
    chunk_ += '\n';
  }

  void Flush() {
    stream_->write(chunk_.data(), static_cast<std::streamsize>(chunk_.size()));
    chunk_.clear();
  }

  bool ascii_;
  bool swap_;
  std::ostream* stream_;
  std::string chunk_;
};

void CheckRowCounts(const PlyElement& element) {
  for (const PlyProperty& property : element.properties) {
    if (!property.is_list) {
      CHECK_EQ(property.values.size(), element.count) << "rows of PLY property " << property.name;
      continue;
    }
    CHECK_EQ(property.list_sizes.size(), element.count)
        << "lists of PLY property " << property.name;
    CHECK_EQ(
        property.values.size(),
        std::accumulate(property.list_sizes.begin(), property.list_sizes.end(), std::size_t{0}))
        << "values of PLY property " << property.name;
  }
}

}  // namespace

Status WritePly(const std::string& path, const PlyDocument& document) {
  for (const PlyElement& element : document.elements) CheckRowCounts(element);
  StatusOr<std::unique_ptr<AtomicFile>> file = AtomicFile::Create(path);
  if (!file.ok()) return file.status();
  std::ostream& stream = (*file)->stream();
  stream << FormatPlyHeader(document);
  BodyWriter writer(document.format, &stream);
  for (const PlyElement& element : document.elements) writer.Write(element);
  return (*file)->Commit();
}

}  // namespace ceres_ed
