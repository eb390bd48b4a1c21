// A PLY file in memory: all of its contents and nothing else.
#ifndef CERES_ED_IO_MESH_PLY_DOCUMENT_H_
#define CERES_ED_IO_MESH_PLY_DOCUMENT_H_

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace ceres_ed {

enum class PlyFormat { kAscii, kBinaryLittleEndian, kBinaryBigEndian };

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

// One column of an element.
struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat32;
  // One value for each row or, if `is_list`, the lists of all rows one after the other. A double
  // can represent every PLY type exactly.
  std::vector<double> values;
  bool is_list = false;
  // For lists: the type of the number before each list that gives its length. It is an integer
  // type.
  PlyType list_count_type = PlyType::kUint8;
  // For lists: the length of each row's list. The sum is values.size().
  std::vector<std::uint32_t> list_sizes;
};

struct PlyElement {
  std::string name;
  // The number of rows. Every property has as many values (scalars) or list_sizes (lists).
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  // Returns the property of that name, or null.
  const PlyProperty* Find(const std::string& property) const {
    for (const PlyProperty& candidate : properties) {
      if (candidate.name == property) return &candidate;
    }
    return nullptr;
  }
  PlyProperty* Find(const std::string& property) {
    return const_cast<PlyProperty*>(static_cast<const PlyElement*>(this)->Find(property));
  }
};

// Elements and properties are in the order of the file. Comments and obj_info lines are stored
// without the keyword and one blank after it; they are written before the elements.
struct PlyDocument {
  PlyFormat format = PlyFormat::kBinaryLittleEndian;
  std::vector<std::string> comments;
  std::vector<std::string> obj_info;
  std::vector<PlyElement> elements;
  // What the reader left out or had to guess, a sentence for each kind; not written to files.
  std::vector<std::string> warnings;

  // Returns the element of that name, or null.
  const PlyElement* Find(const std::string& element) const {
    for (const PlyElement& candidate : elements) {
      if (candidate.name == element) return &candidate;
    }
    return nullptr;
  }
  PlyElement* Find(const std::string& element) {
    return const_cast<PlyElement*>(static_cast<const PlyDocument*>(this)->Find(element));
  }
};

// Returns the number of bytes of one value in a binary file.
inline std::size_t PlyTypeSize(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kInt32:
    case PlyType::kUint32:
    case PlyType::kFloat32:
      return 4;
    case PlyType::kFloat64:
      return 8;
  }
  return 0;
}

inline bool IsFloatingPlyType(PlyType type) {
  return type == PlyType::kFloat32 || type == PlyType::kFloat64;
}

// Returns a column with one value for each row.
inline PlyProperty MakePlyScalar(std::string name, PlyType type, std::vector<double> values = {}) {
  PlyProperty property;
  property.name = std::move(name);
  property.type = type;
  property.values = std::move(values);
  return property;
}

// Returns a column of lists, for example faces.
inline PlyProperty MakePlyList(std::string name, PlyType list_count_type, PlyType type) {
  PlyProperty property;
  property.name = std::move(name);
  property.type = type;
  property.is_list = true;
  property.list_count_type = list_count_type;
  return property;
}

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_PLY_DOCUMENT_H_
