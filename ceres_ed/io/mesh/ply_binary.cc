#include "ceres_ed/io/mesh/ply_binary.h"

#include <ceres_ed/io/mesh/byte_order.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ceres_ed {
namespace {

// Converts `count` numbers of one type to doubles; they begin `stride` bytes apart.
using Decode = void (*)(const char* bytes, std::size_t stride, std::size_t count, double* values);

template <typename T, bool kReversed>
void DecodeNumbers(const char* bytes, std::size_t stride, std::size_t count, double* values) {
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = static_cast<double>(NumberFromBytes<T, kReversed>(bytes + i * stride));
  }
}

template <bool kReversed>
Decode DecoderOf(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
      return DecodeNumbers<std::int8_t, kReversed>;
    case PlyType::kUint8:
      return DecodeNumbers<std::uint8_t, kReversed>;
    case PlyType::kInt16:
      return DecodeNumbers<std::int16_t, kReversed>;
    case PlyType::kUint16:
      return DecodeNumbers<std::uint16_t, kReversed>;
    case PlyType::kInt32:
      return DecodeNumbers<std::int32_t, kReversed>;
    case PlyType::kUint32:
      return DecodeNumbers<std::uint32_t, kReversed>;
    case PlyType::kFloat32:
      return DecodeNumbers<float, kReversed>;
    case PlyType::kFloat64:
      break;
  }
  return DecodeNumbers<double, kReversed>;
}

// A property, and the functions that convert its bytes to values.
struct Column {
  Column(PlyProperty* property, bool reversed)
      : property(property),
        value_size(PlyTypeSize(property->type)),
        decode(DecoderFor(property->type, reversed)),
        length_size(property->is_list ? PlyTypeSize(property->list_count_type) : 0),
        decode_length(DecoderFor(property->list_count_type, reversed)) {}

  static Decode DecoderFor(PlyType type, bool reversed) {
    return reversed ? DecoderOf<true>(type) : DecoderOf<false>(type);
  }

  // The smallest number of bytes of a row. A list may be empty.
  std::size_t MinSize() const { return property->is_list ? length_size : value_size; }

  PlyProperty* property;
  std::size_t value_size;
  Decode decode;
  // The size of the number before a list that gives its length.
  std::size_t length_size;
  Decode decode_length;
};

class BinaryBodyReader {
 public:
  BinaryBodyReader(const std::string& path, std::string_view body, bool reversed)
      : path_(path), rest_(body), reversed_(reversed) {}

  Status Read(PlyElement* element) {
    std::vector<Column> columns;
    bool has_lists = false;
    for (PlyProperty& property : element->properties) {
      columns.emplace_back(&property, reversed_);
      has_lists = has_lists || property.is_list;
    }
    if (columns.empty()) return Status::Ok();
    return has_lists ? ReadRows(*element, columns) : ReadTable(*element, columns);
  }

 private:
  static std::size_t MinRowSize(const std::vector<Column>& columns) {
    std::size_t size = 0;
    for (const Column& column : columns) size += column.MinSize();
    return size;
  }

  // Reads rows that all have the same size: each property is a column of a table.
  Status ReadTable(const PlyElement& element, const std::vector<Column>& columns) {
    // This number of rows stays in the cache while one column after the other is read from them.
    constexpr std::size_t kBlock = 1024;
    const std::size_t row_size = MinRowSize(columns);
    const std::size_t rows_there = rest_.size() / row_size;
    if (rows_there < element.count) return TruncatedError(element, rows_there);
    for (const Column& column : columns) column.property->values.resize(element.count);
    for (std::size_t row = 0; row < element.count; row += kBlock) {
      const std::size_t rows = std::min(kBlock, element.count - row);
      const char* bytes = rest_.data();
      for (const Column& column : columns) {
        column.decode(bytes, row_size, rows, column.property->values.data() + row);
        bytes += column.value_size;
      }
      rest_.remove_prefix(rows * row_size);
    }
    return Status::Ok();
  }

  // Reads rows with lists, whose sizes differ.
  Status ReadRows(const PlyElement& element, const std::vector<Column>& columns) {
    Reserve(element, columns);
    for (std::size_t row = 0; row < element.count; ++row) {
      for (const Column& column : columns) {
        double length = 1.0;
        if (column.property->is_list) {
          if (rest_.size() < column.length_size) return TruncatedError(element, row);
          column.decode_length(rest_.data(), column.length_size, 1, &length);
          rest_.remove_prefix(column.length_size);
          if (length < 0.0) return NegativeLengthError(*column.property, row);
          column.property->list_sizes.push_back(static_cast<std::uint32_t>(length));
        }
        if (!AppendValues(column, static_cast<std::size_t>(length))) {
          return TruncatedError(element, row);
        }
      }
    }
    return Status::Ok();
  }

  // Appends the next `count` values to the property. Returns false if the file ends before the last
  // one.
  bool AppendValues(const Column& column, std::size_t count) {
    if (rest_.size() / column.value_size < count) return false;
    std::vector<double>& values = column.property->values;
    const std::size_t old_size = values.size();
    values.resize(old_size + count);
    column.decode(rest_.data(), column.value_size, count, values.data() + old_size);
    rest_.remove_prefix(count * column.value_size);
    return true;
  }

  // Reserves memory for the number of values in the header, but not for more than the rest of the
  // file can contain.
  void Reserve(const PlyElement& element, const std::vector<Column>& columns) {
    constexpr std::size_t kTypicalLength = 3;
    const std::size_t rows = std::min(element.count, rest_.size() / MinRowSize(columns));
    for (const Column& column : columns) {
      if (!column.property->is_list) {
        column.property->values.reserve(rows);
        continue;
      }
      column.property->list_sizes.reserve(rows);
      column.property->values.reserve(
          std::min(rows * kTypicalLength, rest_.size() / column.value_size));
    }
  }

  Status TruncatedError(const PlyElement& element, std::size_t row) const {
    return Status::Error(path_ + ": truncated: element '" + element.name + "' promises " +
                         std::to_string(element.count) + " rows, the file ends in row " +
                         std::to_string(row));
  }

  Status NegativeLengthError(const PlyProperty& property, std::size_t row) const {
    return Status::Error(path_ + ": row " + std::to_string(row) + ": the list '" + property.name +
                         "' has a negative length, expected at least 0");
  }

  const std::string& path_;
  std::string_view rest_;
  bool reversed_;
};

}  // namespace

Status ReadPlyBinaryBody(const std::string& path, std::string_view body, PlyDocument* document) {
  const bool little_endian = document->format == PlyFormat::kBinaryLittleEndian;
  BinaryBodyReader reader(path, body, little_endian != HostIsLittleEndian());
  for (PlyElement& element : document->elements) {
    Status status = reader.Read(&element);
    if (!status.ok()) return status;
  }
  return Status::Ok();
}

}  // namespace ceres_ed
