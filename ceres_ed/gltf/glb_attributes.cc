#include "ceres_ed/gltf/glb_attributes.h"

#include <ceres_ed/gltf/tiny_gltf.h>
#include <ceres_ed/io/mesh/byte_order.h>

#include <array>
#include <cstdint>
#include <limits>
#include <utility>

namespace ceres_ed {
namespace {

constexpr std::array<std::pair<PlyType, const char*>, 8> kTypeNames = {
    {{PlyType::kInt8, "int8"},
     {PlyType::kUint8, "uint8"},
     {PlyType::kInt16, "int16"},
     {PlyType::kUint16, "uint16"},
     {PlyType::kInt32, "int32"},
     {PlyType::kUint32, "uint32"},
     {PlyType::kFloat32, "float32"},
     {PlyType::kFloat64, "float64"}}};

template <typename T>
T LittleEndian(const unsigned char* bytes) {
  const char* const own = reinterpret_cast<const char*>(bytes);
  return HostIsLittleEndian() ? NumberFromBytes<T, false>(own) : NumberFromBytes<T, true>(own);
}

template <typename T>
double Value(const unsigned char* bytes, bool is_normalized) {
  const auto value = static_cast<double>(LittleEndian<T>(bytes));
  return is_normalized ? value / static_cast<double>(std::numeric_limits<T>::max()) : value;
}

double ValueAt(int type, const unsigned char* bytes, bool is_normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return Value<std::int8_t>(bytes, is_normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return Value<std::uint8_t>(bytes, is_normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return Value<std::int16_t>(bytes, is_normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return Value<std::uint16_t>(bytes, is_normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return Value<std::uint32_t>(bytes, is_normalized);
    default:
      return static_cast<double>(LittleEndian<float>(bytes));
  }
}

std::optional<PlyType> TypeOf(int component_type) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return PlyType::kInt8;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return PlyType::kUint8;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return PlyType::kInt16;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return PlyType::kUint16;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return PlyType::kUint32;
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return PlyType::kFloat32;
    default:
      return std::nullopt;
  }
}

// The bytes of an accessor.
struct Rows {
  const unsigned char* first = nullptr;
  std::size_t stride = 0;
};

StatusOr<Rows> FindRows(const tinygltf::Model& model,
                        const tinygltf::Accessor& accessor,
                        std::size_t row_size) {
  const auto view_index = static_cast<std::size_t>(accessor.bufferView);
  if (accessor.bufferView < 0 || view_index >= model.bufferViews.size()) {
    return Status::Error("an accessor has no data");
  }
  const tinygltf::BufferView& view = model.bufferViews[view_index];
  const auto buffer_index = static_cast<std::size_t>(view.buffer);
  if (view.buffer < 0 || buffer_index >= model.buffers.size()) {
    return Status::Error("the data of an accessor are not there");
  }
  const std::vector<unsigned char>& data = model.buffers[buffer_index].data;
  Rows rows;
  rows.stride = view.byteStride > 0 ? view.byteStride : row_size;
  const std::size_t size = data.size();
  const bool begins_inside = view.byteOffset <= size && view.byteLength <= size - view.byteOffset &&
                             accessor.byteOffset <= view.byteLength;
  const std::size_t room = begins_inside ? view.byteLength - accessor.byteOffset : 0;
  const bool fits =
      accessor.count == 0 || (begins_inside && rows.stride <= size && row_size <= room &&
                              (accessor.count - 1) <= (room - row_size) / rows.stride);
  if (!fits) return Status::Error("an accessor leads outside of the data of the file");
  rows.first = data.data() + (begins_inside ? view.byteOffset + accessor.byteOffset : 0);
  return rows;
}

}  // namespace

StatusOr<AttributeValues> ReadAccessor(const tinygltf::Model& model, int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size()) {
    return Status::Error("accessor " + std::to_string(index) + " is not there");
  }
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  if (accessor.sparse.isSparse) return Status::Error("it has sparse accessors, which are not read");
  const std::optional<PlyType> type = TypeOf(accessor.componentType);
  const int components =
      tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
  if (!type.has_value() || components < 1 || components > 4) {
    return Status::Error("an accessor has an unknown type");
  }
  AttributeValues values;
  values.components = static_cast<std::size_t>(components);
  values.count = accessor.count;
  values.type = accessor.normalized ? PlyType::kFloat32 : *type;
  const std::size_t value_size = PlyTypeSize(*type);
  const StatusOr<Rows> rows = FindRows(model, accessor, value_size * values.components);
  if (!rows.ok()) return rows.status();
  values.values.reserve(values.count * values.components);
  for (std::size_t row = 0; row < values.count; ++row) {
    const unsigned char* const begin = rows->first + row * rows->stride;
    for (std::size_t i = 0; i < values.components; ++i) {
      values.values.push_back(
          ValueAt(accessor.componentType, begin + i * value_size, accessor.normalized));
    }
  }
  return values;
}

std::string AccessorNameOf(PlyType type) {
  for (const auto& [entry, name] : kTypeNames) {
    if (entry == type) return name;
  }
  return "";
}

std::optional<PlyType> TypeOfAccessorName(const std::string& name) {
  for (const auto& [entry, entry_name] : kTypeNames) {
    if (name == entry_name) return entry;
  }
  return std::nullopt;
}

}  // namespace ceres_ed
