#include "ceres_ed/io/mesh/ply_binary.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <numeric>
#include <ostream>
#include <system_error>
#include <tuple>
#include <type_traits>
#include <utility>

#include <pcl/io/ply/ply_parser.h>
#include <stdlib.h>
#include <unistd.h>

namespace ceres_ed {
namespace {

using pcl::io::ply::ply_parser;

// Thrown out of a callback, the only way to stop PCL's parser; caught where that is called.
struct NegativeListLength {
  const PlyProperty* property;
};

// PCL reads a signed count of -1 as the largest unsigned one.
template <typename Size>
void AppendListSize(Size size, PlyProperty* property) {
  const bool is_signed = property->list_count_type == PlyType::kInt8 ||
                         property->list_count_type == PlyType::kInt16 ||
                         property->list_count_type == PlyType::kInt32;
  if (is_signed && size > std::numeric_limits<std::make_signed_t<Size>>::max()) {
    throw NegativeListLength{property};
  }
  property->list_sizes.push_back(size);
}

PlyProperty* FindProperty(PlyDocument* document,
                          const std::string& element,
                          const std::string& property) {
  PlyElement* const found = document->Find(element);
  return found == nullptr ? nullptr : found->Find(property);
}

template <typename Scalar>
std::function<void(Scalar)> AppendTo(PlyProperty* property) {
  return [property](Scalar value) { property->values.push_back(static_cast<double>(value)); };
}

// A column that our header does not have (PCL saw other words in a line) gets no callback: then it
// stays short, which is an error in the end.
template <typename Scalar>
void RegisterScalar(PlyDocument* document,
                    ply_parser::scalar_property_definition_callbacks_type* callbacks) {
  callbacks->get<Scalar>() = [document](const std::string& element, const std::string& name) {
    PlyProperty* const property = FindProperty(document, element, name);
    return property == nullptr ? std::function<void(Scalar)>() : AppendTo<Scalar>(property);
  };
}

template <typename Size, typename Scalar>
void RegisterList(PlyDocument* document,
                  ply_parser::list_property_definition_callbacks_type* callbacks) {
  using Callbacks =
      std::tuple<std::function<void(Size)>, std::function<void(Scalar)>, std::function<void()>>;
  callbacks->get<Size, Scalar>() = [document](const std::string& element, const std::string& name) {
    PlyProperty* const property = FindProperty(document, element, name);
    if (property == nullptr) return Callbacks();
    return Callbacks([property](Size size) { AppendListSize(size, property); },
                     AppendTo<Scalar>(property),
                     [] {});
  };
}

template <typename... Scalars>
struct Registrar {
  static void Register(PlyDocument* document, ply_parser* parser) {
    ply_parser::scalar_property_definition_callbacks_type scalars;
    (RegisterScalar<Scalars>(document, &scalars), ...);
    parser->scalar_property_definition_callbacks(scalars);
    ply_parser::list_property_definition_callbacks_type lists;
    (RegisterList<std::uint8_t, Scalars>(document, &lists), ...);
    (RegisterList<std::uint16_t, Scalars>(document, &lists), ...);
    (RegisterList<std::uint32_t, Scalars>(document, &lists), ...);
    parser->list_property_definition_callbacks(lists);
  }
};
using AllTypes = Registrar<pcl::io::ply::int8,
                           pcl::io::ply::uint8,
                           pcl::io::ply::int16,
                           pcl::io::ply::uint16,
                           pcl::io::ply::int32,
                           pcl::io::ply::uint32,
                           pcl::io::ply::float32,
                           pcl::io::ply::float64>;

// Reserves what the header promises, but never more than `body_size` bytes of file can hold.
void ReserveValues(std::size_t body_size, PlyDocument* document) {
  constexpr std::size_t kTypicalListSize = 3;
  for (PlyElement& element : document->elements) {
    std::size_t row_size = 0;
    for (const PlyProperty& property : element.properties) {
      row_size += PlyTypeSize(property.is_list ? property.list_count_type : property.type);
    }
    if (row_size == 0) continue;
    const std::size_t rows = std::min(element.count, body_size / row_size);
    for (PlyProperty& property : element.properties) {
      if (!property.is_list) {
        property.values.reserve(rows);
        continue;
      }
      property.list_sizes.reserve(rows);
      property.values.reserve(
          std::min(rows * kTypicalListSize, body_size / PlyTypeSize(property.type)));
    }
  }
}

std::size_t CompleteRows(const PlyProperty& property) {
  if (!property.is_list) return property.values.size();
  const std::size_t promised =
      std::accumulate(property.list_sizes.begin(), property.list_sizes.end(), std::size_t{0});
  const bool last_is_cut = promised > property.values.size();
  return property.list_sizes.size() - (last_is_cut ? 1 : 0);
}

// Ok when every row is there, else the error of a truncated file.
Status CheckAllRowsRead(const std::string& path, const PlyDocument& document) {
  for (const PlyElement& element : document.elements) {
    std::size_t rows = element.count;
    for (const PlyProperty& property : element.properties) {
      rows = std::min(rows, CompleteRows(property));
    }
    if (rows == element.count) continue;
    return Status::Error(path + ": truncated: element '" + element.name + "' promises " +
                         std::to_string(element.count) + " rows, the file ends in row " +
                         std::to_string(rows));
  }
  return Status::Ok();
}

// The header as PCL takes it, or an empty text where the file's own will do. PCL knows no list
// counts of type char and short (the bytes are the same as those of uchar and ushort), and takes
// the line end of the first line for that of all.
std::string HeaderForParser(const PlyHeader& header) {
  PlyDocument document = header.document;
  bool changed = !header.uniform_line_ends;
  for (PlyElement& element : document.elements) {
    for (PlyProperty& property : element.properties) {
      if (!property.is_list) continue;
      const PlyType old_type = property.list_count_type;
      if (old_type == PlyType::kInt8) property.list_count_type = PlyType::kUint8;
      if (old_type == PlyType::kInt16) property.list_count_type = PlyType::kUint16;
      changed = changed || property.list_count_type != old_type;
    }
  }
  return changed ? FormatPlyHeader(document) : std::string();
}

// A copy of a PLY under another header, in the directory for temporary files while this lives.
class RewrittenCopy {
 public:
  RewrittenCopy() = default;
  ~RewrittenCopy() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  RewrittenCopy(const RewrittenCopy&) = delete;
  RewrittenCopy& operator=(const RewrittenCopy&) = delete;

  Status Create(const std::string& original,
                std::size_t old_header_size,
                const std::string& new_header) {
    std::error_code error;
    const std::filesystem::path directory = std::filesystem::temp_directory_path(error);
    std::string name = (directory / "ceres_ed_ply_XXXXXX").string();
    const int descriptor = error ? -1 : ::mkstemp(name.data());
    if (descriptor < 0) return Status::Error(original + ": no room for a temporary copy of it");
    ::close(descriptor);
    path_ = name;
    std::ofstream copy(path_, std::ios::binary);
    copy << new_header;
    std::ifstream source(original, std::ios::binary);
    source.seekg(static_cast<std::streamoff>(old_header_size));
    // Inserting an empty buffer would set the failure bit.
    if (source.peek() != std::ifstream::traits_type::eof()) copy << source.rdbuf();
    copy.close();
    return copy ? Status::Ok()
                : Status::Error(original + ": no room for a temporary copy of it in " + path_);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace

Status ReadPlyBinaryBody(const std::string& path, std::size_t file_size, PlyHeader* header) {
  RewrittenCopy copy;
  const std::string new_header = HeaderForParser(*header);
  if (!new_header.empty()) {
    Status status = copy.Create(path, header->size, new_header);
    if (!status.ok()) return status;
  }

  PlyDocument& document = header->document;
  ReserveValues(file_size - std::min(file_size, header->size), &document);
  std::size_t parser_line = 0;
  std::string parser_message;
  ply_parser parser;
  parser.error_callback([&](std::size_t line, const std::string& message) {
    parser_line = line;
    parser_message = message;
  });
  AllTypes::Register(&document, &parser);
  try {
    // The verdict is CheckAllRowsRead's: PCL refuses bytes behind the last row too.
    const bool parsed = parser.parse(new_header.empty() ? path : copy.path());
    const bool in_header = parser_line < static_cast<std::size_t>(header->num_lines);
    if (!parsed && in_header) {
      return Status::Error(path + ": line " + std::to_string(parser_line) + ": " + parser_message);
    }
  } catch (const NegativeListLength& bad) {
    return Status::Error(path + ": row " + std::to_string(bad.property->list_sizes.size()) +
                         ": the list '" + bad.property->name +
                         "' has a negative length, expected at least 0");
  }
  return CheckAllRowsRead(path, document);
}

}  // namespace ceres_ed
