#include <ceres_ed/gltf/glb_attributes.h>
#include <ceres_ed/gltf/glb_file.h>
#include <ceres_ed/gltf/tiny_gltf.h>
#include <ceres_ed/io/mesh/byte_order.h>
#include <ceres_ed/io/mesh/mesh_view.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <limits>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

namespace ceres_ed {
namespace {

using Columns = std::vector<const PlyProperty*>;

class GlbBuilder {
 public:
  explicit GlbBuilder(const MeshView& view) : view_(view) {}

  tinygltf::Model Build() {
    model_.asset.version = "2.0";
    model_.asset.generator = "ceres_ed";
    model_.buffers.emplace_back();
    AddVertices();
    if (view_.NumFaces() > 0) AddTriangles();
    primitive_.mode = view_.NumFaces() > 0 ? TINYGLTF_MODE_TRIANGLES : TINYGLTF_MODE_POINTS;
    tinygltf::Mesh mesh;
    mesh.primitives.push_back(primitive_);
    model_.meshes.push_back(std::move(mesh));
    tinygltf::Node node;
    node.mesh = 0;
    model_.nodes.push_back(std::move(node));
    tinygltf::Scene scene;
    scene.nodes = {0};
    model_.scenes.push_back(std::move(scene));
    model_.defaultScene = 0;
    return std::move(model_);
  }

 private:
  void AddVertices() {
    const PlyElement& vertices = view_.vertices();
    std::set<const PlyProperty*> written;
    const auto add = [&](const char* name, const std::vector<const char*>& names) {
      Columns columns;
      for (const char* const column : names) {
        const PlyProperty* const found = vertices.Find(column);
        if (found == nullptr || found->is_list) return false;
        columns.push_back(found);
      }
      written.insert(columns.begin(), columns.end());
      AddAttribute(name, columns);
      return true;
    };
    add("POSITION", {"x", "y", "z"});
    if (!add("NORMAL", {"nx", "ny", "nz"})) add("NORMAL", {"normal_x", "normal_y", "normal_z"});
    if (!add("COLOR_0", {"red", "green", "blue", "alpha"})) {
      add("COLOR_0", {"red", "green", "blue"});
    }
    add("TEXCOORD_0", {"s", "t"});
    for (const PlyProperty& column : vertices.properties) {
      if (column.is_list || written.count(&column) > 0) continue;
      AddAttribute("_" + column.name, {&column});
    }
  }

  void AddAttribute(const std::string& name, const Columns& columns) {
    const bool is_color = name == "COLOR_0";
    const bool is_own = name[0] == '_';
    const PlyType type = columns.front()->type;
    const bool same_type = std::all_of(
        columns.begin(), columns.end(), [type](const PlyProperty* c) { return c->type == type; });
    const bool as_bytes = (is_color || is_own) && same_type && type == PlyType::kUint8;
    const bool as_shorts = (is_color || is_own) && same_type && type == PlyType::kUint16;
    tinygltf::Accessor accessor;
    accessor.componentType = as_bytes    ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE
                             : as_shorts ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT
                                         : TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor.normalized = is_color && (as_bytes || as_shorts);
    constexpr std::array<int, 4> kShapes = {
        TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4};
    accessor.type = kShapes[columns.size() - 1];
    accessor.count = view_.vertices().count;
    if (is_own) accessor.name = AccessorNameOf(type);
    std::vector<unsigned char> bytes;
    std::vector<double> low(columns.size(), std::numeric_limits<double>::infinity());
    std::vector<double> high(columns.size(), -std::numeric_limits<double>::infinity());
    std::size_t row_size = 0;
    for (std::size_t row = 0; row < accessor.count; ++row) {
      for (std::size_t i = 0; i < columns.size(); ++i) {
        double value = columns[i]->values[row];
        if (is_color && !accessor.normalized) value /= LargestColor(columns[i]->type);
        if (as_bytes) Append(static_cast<std::uint8_t>(value), &bytes);
        if (as_shorts) Append(static_cast<std::uint16_t>(value), &bytes);
        if (as_bytes || as_shorts) continue;
        const auto rounded = static_cast<float>(value);
        Append(rounded, &bytes);
        if (!std::isfinite(rounded)) continue;
        low[i] = std::min(low[i], static_cast<double>(rounded));
        high[i] = std::max(high[i], static_cast<double>(rounded));
      }
      // Each row begins at a multiple of four bytes.
      while (bytes.size() % 4 != 0) bytes.push_back(0);
      if (row == 0) row_size = bytes.size();
    }
    if (name == "POSITION" && std::isfinite(low[0] + low[1] + low[2])) {
      accessor.minValues = low;
      accessor.maxValues = high;
    }
    const bool is_padded = as_bytes || as_shorts;
    primitive_.attributes[name] =
        AddAccessor(accessor, bytes, TINYGLTF_TARGET_ARRAY_BUFFER, is_padded ? row_size : 0);
  }

  void AddTriangles() {
    std::vector<unsigned char> bytes;
    tinygltf::Accessor accessor;
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.type = TINYGLTF_TYPE_SCALAR;
    for (std::size_t face = 0; face < view_.NumFaces(); ++face) {
      for (const std::array<std::size_t, 3>& triangle : view_.TrianglesOf(face)) {
        for (const std::size_t corner : triangle) {
          Append(static_cast<std::uint32_t>(corner), &bytes);
        }
        accessor.count += 3;
      }
    }
    primitive_.indices = AddAccessor(accessor, bytes, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, 0);
  }

  int AddAccessor(tinygltf::Accessor accessor,
                  const std::vector<unsigned char>& bytes,
                  int target,
                  std::size_t stride) {
    std::vector<unsigned char>& data = model_.buffers[0].data;
    tinygltf::BufferView buffer_view;
    buffer_view.buffer = 0;
    buffer_view.byteOffset = data.size();
    buffer_view.byteLength = bytes.size();
    buffer_view.byteStride = stride;
    buffer_view.target = target;
    data.insert(data.end(), bytes.begin(), bytes.end());
    accessor.bufferView = static_cast<int>(model_.bufferViews.size());
    model_.bufferViews.push_back(std::move(buffer_view));
    model_.accessors.push_back(std::move(accessor));
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  template <typename T>
  static void Append(T number, std::vector<unsigned char>* bytes) {
    std::array<unsigned char, sizeof(T)> own;
    std::memcpy(own.data(), &number, sizeof(T));
    if (!HostIsLittleEndian()) std::reverse(own.begin(), own.end());
    bytes->insert(bytes->end(), own.begin(), own.end());
  }

  const MeshView& view_;
  tinygltf::Model model_;
  tinygltf::Primitive primitive_;
};

}  // namespace

Status EncodeGlb(const std::string& path, const PlyDocument& document, std::string* bytes) {
  const StatusOr<MeshView> view = MeshView::Of(path, document);
  if (!view.ok()) return view.status();
  if (view->vertices().count == 0) {
    return Status::Error(path + ": a GLB file holds at least one vertex, and there are none");
  }
  try {
    tinygltf::Model model = GlbBuilder(*view).Build();
    std::ostringstream stream;
    if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model,
                                                     stream,
                                                     /*prettyPrint=*/false,
                                                     /*writeBinary=*/true)) {
      return Status::Error(path + ": tinygltf cannot write it");
    }
    *bytes = stream.str();
  } catch (const std::exception& error) {
    return Status::Error(path + ": tinygltf cannot write it: " + error.what());
  }
  return Status::Ok();
}

}  // namespace ceres_ed
