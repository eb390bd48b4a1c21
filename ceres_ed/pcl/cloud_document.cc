#include "ceres_ed/pcl/cloud_document.h"

#include <ceres_ed/io/mesh/byte_order.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace ceres_ed {
namespace {

using Field = pcl::PCLPointField;

struct FieldType {
  std::uint8_t pcl;
  PlyType ply;
};
constexpr FieldType kTypes[] = {
    {Field::BOOL, PlyType::kUint8},
    {Field::UINT8, PlyType::kUint8},
    {Field::INT8, PlyType::kInt8},
    {Field::UINT16, PlyType::kUint16},
    {Field::INT16, PlyType::kInt16},
    {Field::UINT32, PlyType::kUint32},
    {Field::INT32, PlyType::kInt32},
    {Field::FLOAT32, PlyType::kFloat32},
    {Field::FLOAT64, PlyType::kFloat64},
};

std::uint8_t PclTypeOf(PlyType type) {
  const auto* const entry =
      std::find_if(std::begin(kTypes), std::end(kTypes), [type](const FieldType& candidate) {
        return candidate.ply == type && candidate.pcl != Field::BOOL;
      });
  return entry->pcl;
}

// Calls `use` with a zero of the C++ type of `type`.
template <typename Use>
auto WithType(PlyType type, const Use& use) {
  switch (type) {
    case PlyType::kInt8:
      return use(std::int8_t{});
    case PlyType::kUint8:
      return use(std::uint8_t{});
    case PlyType::kInt16:
      return use(std::int16_t{});
    case PlyType::kUint16:
      return use(std::uint16_t{});
    case PlyType::kInt32:
      return use(std::int32_t{});
    case PlyType::kUint32:
      return use(std::uint32_t{});
    case PlyType::kFloat32:
      return use(float{});
    case PlyType::kFloat64:
      break;
  }
  return use(double{});
}

double ValueAt(PlyType type, const std::uint8_t* bytes) {
  return WithType(type, [bytes](auto zero) {
    return static_cast<double>(
        NumberFromBytes<decltype(zero), false>(reinterpret_cast<const char*>(bytes)));
  });
}

// Nobody's point has so many: keeps a count that was read from a file from taking memory.
constexpr std::uint32_t kMaxCount = 1 << 20;

std::uint32_t CountOf(const Field& field) { return std::max<std::uint32_t>(field.count, 1); }

bool IsColor(const Field& field) {
  return (field.name == "rgb" || field.name == "rgba") && CountOf(field) == 1 &&
         (field.datatype == Field::FLOAT32 || field.datatype == Field::UINT32);
}

class DocumentBuilder {
 public:
  DocumentBuilder(const std::string& name, const pcl::PCLPointCloud2& cloud)
      : name_(name), cloud_(cloud) {}

  StatusOr<PlyDocument> Build() {
    vertices_.name = "vertex";
    vertices_.count = std::size_t{cloud_.width} * cloud_.height;
    Status status = CheckSizes();
    for (const Field& field : cloud_.fields) {
      if (!status.ok()) return status;
      if (field.name != "_") status = AddField(field);
    }
    if (!status.ok()) return status;
    PlyDocument document;
    if (cloud_.height > 1) {
      document.obj_info = {"num_cols " + std::to_string(cloud_.width),
                           "num_rows " + std::to_string(cloud_.height)};
    }
    document.elements.push_back(std::move(vertices_));
    return document;
  }

 private:
  // Whether the data has the bytes of every point. Each point takes some, so that no size of a
  // cloud is larger than its data.
  Status CheckSizes() const {
    if (vertices_.count == 0) return Status::Ok();
    const std::size_t row_size = std::size_t{cloud_.width} * cloud_.point_step;
    const bool rows_fit = cloud_.height == 1 || cloud_.row_step >= row_size;
    const std::size_t size = RowStep() * (cloud_.height - std::size_t{1}) + row_size;
    if (cloud_.point_step > 0 && rows_fit && size <= cloud_.data.size()) return Status::Ok();
    return Error("has " + std::to_string(cloud_.data.size()) + " bytes, expected " +
                 std::to_string(vertices_.count) + " points of " +
                 std::to_string(cloud_.point_step) + " bytes");
  }

  Status AddField(const Field& field) {
    const std::optional<PlyType> type = PlyTypeOf(field.datatype);
    if (!type.has_value()) {
      return Error("field '" + field.name + "' has integers of 64 bits or an unknown type");
    }
    const std::size_t size = PlyTypeSize(*type) * CountOf(field);
    if (CountOf(field) > kMaxCount || field.offset + size > cloud_.point_step) {
      return Error("field '" + field.name + "' lies outside the bytes of a point");
    }
    if (IsColor(field)) return AddColor(field);
    const std::uint32_t count = CountOf(field);
    PlyProperty property = count > 1 ? MakePlyList(field.name, PlyType::kUint32, *type)
                                     : MakePlyScalar(field.name, *type);
    property.values.reserve(vertices_.count * count);
    ForEachPoint([&](const std::uint8_t* point) {
      for (std::uint32_t i = 0; i < count; ++i) {
        property.values.push_back(ValueAt(*type, point + field.offset + i * PlyTypeSize(*type)));
      }
    });
    if (count > 1) property.list_sizes.assign(vertices_.count, count);
    return Add(std::move(property));
  }

  // Red stands in bits 16 to 23, green, blue below, alpha above.
  Status AddColor(const Field& field) {
    constexpr std::array<std::pair<const char*, int>, 4> kChannels = {
        {{"red", 16}, {"green", 8}, {"blue", 0}, {"alpha", 24}}};
    for (const auto& [channel, shift] : kChannels) {
      if (shift == 24 && field.name == "rgb") break;
      PlyProperty property = MakePlyScalar(channel, PlyType::kUint8);
      property.values.reserve(vertices_.count);
      ForEachPoint([&, shift = shift](const std::uint8_t* point) {
        const double packed = ValueAt(PlyType::kUint32, point + field.offset);
        property.values.push_back((static_cast<std::uint32_t>(packed) >> shift) & 255U);
      });
      Status status = Add(std::move(property));
      if (!status.ok()) return status;
    }
    return Status::Ok();
  }

  Status Add(PlyProperty property) {
    // A PLY's header separates names by blanks.
    const bool usable = std::all_of(property.name.begin(), property.name.end(), [](char c) {
      return static_cast<unsigned char>(c) > ' ' && c != '\x7f';
    });
    if (property.name.empty() || !usable) return Error("a field has a name with blanks, or none");
    if (vertices_.Find(property.name) != nullptr) {
      return Error("two fields '" + property.name + "', expected one");
    }
    vertices_.properties.push_back(std::move(property));
    return Status::Ok();
  }

  template <typename Use>
  void ForEachPoint(const Use& use) const {
    for (std::size_t row = 0; row < cloud_.height; ++row) {
      const std::uint8_t* point = cloud_.data.data() + row * RowStep();
      for (std::size_t column = 0; column < cloud_.width; ++column, point += cloud_.point_step) {
        use(point);
      }
    }
  }

  // Where there is one row, nobody need have set its size.
  std::size_t RowStep() const { return cloud_.height > 1 ? cloud_.row_step : 0; }

  Status Error(const std::string& what) const { return Status::Error(name_ + ": " + what); }

  const std::string& name_;
  const pcl::PCLPointCloud2& cloud_;
  PlyElement vertices_;
};

// A field and where its values come from.
struct Source {
  const PlyProperty* property;
  // More of them for a packed colour: red green blue, and alpha or null.
  std::array<const PlyProperty*, 4> color = {};
  PlyType type = PlyType::kFloat32;
};

const PlyProperty* FindByte(const PlyElement& vertices, const char* name) {
  const PlyProperty* const property = vertices.Find(name);
  const bool usable =
      property != nullptr && !property->is_list && property->type == PlyType::kUint8;
  return usable ? property : nullptr;
}

bool IsVectorName(const std::string& name) {
  constexpr const char* kNames[] = {
      "x", "y", "z", "nx", "ny", "nz", "normal_x", "normal_y", "normal_z"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

std::string PclNameOf(const std::string& name) {
  if (name == "nx" || name == "ny" || name == "nz") return std::string("normal_") + name[1];
  return name;
}

class PclBuilder {
 public:
  PclBuilder(const std::string& name, const PlyElement& vertices, bool single_precision)
      : name_(name), vertices_(vertices), single_precision_(single_precision) {}

  Status Build(pcl::PCLPointCloud2* cloud) {
    if (vertices_.count > std::numeric_limits<std::uint32_t>::max()) {
      return Status::Error(name_ + ": " + std::to_string(vertices_.count) +
                           " points, PCL holds at most 4294967295");
    }
    color_ = {FindByte(vertices_, "red"),
              FindByte(vertices_, "green"),
              FindByte(vertices_, "blue"),
              FindByte(vertices_, "alpha")};
    has_color_ = color_[0] != nullptr && color_[1] != nullptr && color_[2] != nullptr;
    for (const PlyProperty& property : vertices_.properties) {
      Status status = AddField(property, cloud);
      if (!status.ok()) return status;
    }
    cloud->data.resize(vertices_.count * cloud->point_step);
    for (std::size_t i = 0; i < sources_.size(); ++i) Fill(sources_[i], cloud->fields[i], cloud);
    return Status::Ok();
  }

 private:
  Status AddField(const PlyProperty& property, pcl::PCLPointCloud2* cloud) {
    const bool is_color =
        has_color_ && std::find(color_.begin(), color_.end(), &property) != color_.end();
    if (is_color && &property != color_[0]) return Status::Ok();
    Source source{&property};
    source.type = property.type;
    if (is_color) {
      source.color = color_;
      source.type = PlyType::kUint32;
    } else if (single_precision_ && IsVectorName(property.name)) {
      source.type = PlyType::kFloat32;
    }
    Field field;
    field.name = is_color ? (color_[3] != nullptr ? "rgba" : "rgb") : PclNameOf(property.name);
    // PCL keeps the bits of `rgb` in a float.
    field.datatype =
        field.name == "rgb" && is_color ? std::uint8_t{Field::FLOAT32} : PclTypeOf(source.type);
    field.count = 1;
    if (property.is_list) {
      const std::vector<std::uint32_t>& sizes = property.list_sizes;
      if (!sizes.empty()) field.count = sizes.front();
      const bool equal = std::all_of(
          sizes.begin(), sizes.end(), [&](std::uint32_t size) { return size == field.count; });
      if (!equal || field.count == 0) {
        return Status::Error(name_ + ": the lists of property '" + property.name +
                             "' differ in length or are empty, expected one length for all points");
      }
    }
    field.offset = cloud->point_step;
    const std::size_t step = field.offset + PlyTypeSize(source.type) * std::size_t{field.count};
    if (step > std::numeric_limits<std::int32_t>::max()) {
      return Status::Error(name_ + ": a point of more than 2147483647 bytes");
    }
    cloud->point_step = static_cast<std::uint32_t>(step);
    cloud->fields.push_back(field);
    sources_.push_back(source);
    return Status::Ok();
  }

  void Fill(const Source& source, const Field& field, pcl::PCLPointCloud2* cloud) const {
    if (vertices_.count == 0) return;
    const std::size_t size = PlyTypeSize(source.type);
    std::uint8_t* point = cloud->data.data() + field.offset;
    for (std::size_t row = 0; row < vertices_.count; ++row, point += cloud->point_step) {
      for (std::size_t i = 0; i < field.count; ++i) {
        const double value = source.color[0] != nullptr
                                 ? PackedColor(source.color, row)
                                 : source.property->values[row * field.count + i];
        StoreNumber(source.type, value, point + i * size);
      }
    }
  }

  static double PackedColor(const std::array<const PlyProperty*, 4>& color, std::size_t row) {
    const auto byte = [&color, row](std::size_t i) {
      return static_cast<std::uint32_t>(color[i]->values[row]);
    };
    const std::uint32_t alpha = color[3] != nullptr ? byte(3) : 255U;
    return alpha << 24 | byte(0) << 16 | byte(1) << 8 | byte(2);
  }

  const std::string& name_;
  const PlyElement& vertices_;
  bool single_precision_;
  std::array<const PlyProperty*, 4> color_ = {};
  bool has_color_ = false;
  std::vector<Source> sources_;
};

// The number behind `keyword` in the obj_info lines, or 0.
std::uint32_t InfoNumber(const PlyDocument& document, const std::string& keyword) {
  for (const std::string& line : document.obj_info) {
    if (line.compare(0, keyword.size() + 1, keyword + ' ') != 0) continue;
    const unsigned long long number = std::strtoull(line.c_str() + keyword.size(), nullptr, 10);
    if (number <= std::numeric_limits<std::uint32_t>::max()) {
      return static_cast<std::uint32_t>(number);
    }
  }
  return 0;
}

// The size in rows and columns, where the document has one that is right.
void SetShape(const PlyDocument& document, std::size_t count, pcl::PCLPointCloud2* cloud) {
  const std::uint32_t columns = InfoNumber(document, "num_cols");
  const std::uint32_t rows = InfoNumber(document, "num_rows");
  const bool organised = columns > 0 && rows > 0 && std::size_t{columns} * rows == count;
  cloud->width = organised ? columns : static_cast<std::uint32_t>(count);
  cloud->height = organised ? rows : 1;
  cloud->row_step = cloud->width * cloud->point_step;
}

}  // namespace

std::optional<PlyType> PlyTypeOf(std::uint8_t type) {
  for (const FieldType& entry : kTypes) {
    if (entry.pcl == type) return entry.ply;
  }
  return std::nullopt;
}

void StoreNumber(PlyType type, double value, std::uint8_t* bytes) {
  WithType(type, [value, bytes](auto zero) {
    const auto typed = static_cast<decltype(zero)>(value);
    std::memcpy(bytes, &typed, sizeof(typed));
  });
}

StatusOr<PlyDocument> DocumentFromPcl(const std::string& name, const pcl::PCLPointCloud2& cloud) {
  return DocumentBuilder(name, cloud).Build();
}

Status PclFromDocument(const std::string& name,
                       const PlyDocument& document,
                       bool single_precision,
                       pcl::PCLPointCloud2* cloud) {
  const PlyElement* const vertices = document.Find("vertex");
  if (vertices == nullptr) return Status::Error(name + ": no element 'vertex'");
  *cloud = pcl::PCLPointCloud2();
  Status status = PclBuilder(name, *vertices, single_precision).Build(cloud);
  if (status.ok()) SetShape(document, vertices->count, cloud);
  return status;
}

}  // namespace ceres_ed
