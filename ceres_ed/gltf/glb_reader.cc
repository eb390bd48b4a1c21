#include <ceres_ed/gltf/glb_attributes.h>
#include <ceres_ed/gltf/glb_file.h>
#include <ceres_ed/gltf/tiny_gltf.h>
#include <ceres_ed/io/json_file.h>
#include <ceres_ed/io/mesh/mesh_view.h>
#include <ceres_ed/io/text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <limits>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

// A deeper tree of nodes has a circle.
constexpr int kMaxDepth = 200;

// Pictures are not needed.
// NOLINTNEXTLINE(readability-function-size): tinygltf says its parameters.
bool IgnorePicture(tinygltf::Image* /*image*/,
                   const int /*index*/,
                   std::string* /*error*/,
                   std::string* /*warning*/,
                   int /*width*/,
                   int /*height*/,
                   const unsigned char* /*bytes*/,
                   int /*size*/,
                   void* /*user*/) {
  return true;
}

Eigen::Affine3d TransformOf(const tinygltf::Node& node) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (node.matrix.size() == 16) {
    transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
    return transform;
  }
  if (node.translation.size() == 3) {
    transform.translate(Eigen::Map<const Eigen::Vector3d>(node.translation.data()));
  }
  if (node.rotation.size() == 4) {
    // x y z w, as Eigen keeps them.
    const Eigen::Quaterniond rotation(Eigen::Map<const Eigen::Vector4d>(node.rotation.data()));
    if (rotation.norm() > 0.0) transform.rotate(rotation.normalized());
  }
  if (node.scale.size() == 3) {
    transform.scale(Eigen::Map<const Eigen::Vector3d>(node.scale.data()));
  }
  return transform;
}

class SceneReader {
 public:
  SceneReader(const tinygltf::Model& model, PlyDocument* document)
      : model_(model), document_(document) {}

  Status Read() {
    Status status = ReadNodes();
    if (!status.ok()) return status;
    AddVertices();
    if (!sizes_.empty()) AppendFaces(std::move(corners_), std::move(sizes_), document_);
    AddWarnings();
    return Status::Ok();
  }

 private:
  Status ReadNodes() {
    if (model_.scenes.empty()) {
      for (std::size_t mesh = 0; mesh < model_.meshes.size(); ++mesh) {
        Status status = ReadMesh(static_cast<int>(mesh), Eigen::Affine3d::Identity());
        if (!status.ok()) return status;
      }
      return Status::Ok();
    }
    const int scene = model_.defaultScene;
    const bool is_there = scene >= 0 && scene < static_cast<int>(model_.scenes.size());
    for (const int node : model_.scenes[is_there ? static_cast<std::size_t>(scene) : 0].nodes) {
      Status status = ReadNode(node, Eigen::Affine3d::Identity(), 0);
      if (!status.ok()) return status;
    }
    return Status::Ok();
  }

  Status ReadNode(int index, const Eigen::Affine3d& parent, int depth) {
    const bool is_there = index >= 0 && index < static_cast<int>(model_.nodes.size());
    // Each node has one parent, so that no more are met than there are.
    if (!is_there || depth > kMaxDepth || ++met_ > model_.nodes.size()) {
      return Status::Error("its nodes are no tree");
    }
    const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(index)];
    const Eigen::Affine3d transform = parent * TransformOf(node);
    if (node.mesh >= 0) {
      if (Status status = ReadMesh(node.mesh, transform); !status.ok()) return status;
    }
    for (const int child : node.children) {
      if (Status status = ReadNode(child, transform, depth + 1); !status.ok()) return status;
    }
    return Status::Ok();
  }

  Status ReadMesh(int index, const Eigen::Affine3d& transform) {
    if (index >= static_cast<int>(model_.meshes.size())) {
      return Status::Error("mesh " + std::to_string(index) + " is not there");
    }
    is_placed_ = is_placed_ || !transform.matrix().isIdentity(0.0);
    // Primitives may share their vertices.
    base_of_.clear();
    for (const tinygltf::Primitive& primitive :
         model_.meshes[static_cast<std::size_t>(index)].primitives) {
      if (Status status = ReadPrimitive(primitive, transform); !status.ok()) return status;
    }
    return Status::Ok();
  }

  Status ReadPrimitive(const tinygltf::Primitive& primitive, const Eigen::Affine3d& transform) {
    if (primitive.extensions.count("KHR_draco_mesh_compression") > 0) {
      return Status::Error("it is compressed by Draco, expected a file without compression");
    }
    targets_ += primitive.targets.size();
    if (primitive.mode >= TINYGLTF_MODE_LINE && primitive.mode <= TINYGLTF_MODE_LINE_STRIP) {
      ++lines_;
      return Status::Ok();
    }
    const StatusOr<std::size_t> base = AddAttributes(primitive, transform);
    if (!base.ok()) return base.status();
    if (primitive.mode == TINYGLTF_MODE_POINTS) return Status::Ok();
    std::vector<double> indices;
    if (primitive.indices >= 0) {
      StatusOr<AttributeValues> read = ReadAccessor(model_, primitive.indices);
      if (!read.ok()) return read.status();
      indices = std::move(read->values);
    } else {
      for (std::size_t i = 0; i < last_count_; ++i) indices.push_back(static_cast<double>(i));
    }
    for (const double index : indices) {
      if (index >= 0.0 && index < static_cast<double>(last_count_)) continue;
      return Status::Error("a triangle names vertex " + std::to_string(static_cast<long>(index)) +
                           ", its mesh has " + std::to_string(last_count_));
    }
    AddTriangles(primitive.mode, indices, *base, transform.linear().determinant() < 0.0);
    return Status::Ok();
  }

  void AddTriangles(int mode,
                    const std::vector<double>& indices,
                    std::size_t base,
                    bool is_mirror) {
    const bool is_strip = mode == TINYGLTF_MODE_TRIANGLE_STRIP;
    const bool is_fan = mode == TINYGLTF_MODE_TRIANGLE_FAN;
    const std::size_t step = is_strip || is_fan ? 1 : 3;
    for (std::size_t i = 0; i + 2 < indices.size(); i += step) {
      std::array<double, 3> triangle = {indices[is_fan ? 0 : i], indices[i + 1], indices[i + 2]};
      if (is_mirror != (is_strip && i % 2 == 1)) std::swap(triangle[1], triangle[2]);
      for (const double corner : triangle) corners_.push_back(corner + static_cast<double>(base));
      sizes_.push_back(3);
    }
  }

  // Adds the vertices of a primitive and returns the row of the first one.
  StatusOr<std::size_t> AddAttributes(const tinygltf::Primitive& primitive,
                                      const Eigen::Affine3d& transform) {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) return Status::Error("a mesh has no positions");
    if (const auto known = base_of_.find(position->second); known != base_of_.end()) {
      last_count_ = known->second.second;
      return known->second.first;
    }
    const StatusOr<AttributeValues> points = ReadAccessor(model_, position->second);
    if (!points.ok()) return points.status();
    if (points->components != 3) return Status::Error("positions have not three coordinates");
    const std::size_t base = positions_.size();
    last_count_ = points->count;
    base_of_[position->second] = {base, last_count_};
    for (std::size_t i = 0; i < points->count; ++i) {
      const Eigen::Vector3d point =
          Eigen::Map<const Eigen::Vector3d>(points->values.data() + 3 * i);
      positions_.push_back(transform.matrix().isIdentity(0.0) ? point
                                                              : Eigen::Vector3d(transform * point));
    }
    for (const auto& [name, accessor] : primitive.attributes) {
      if (name == "POSITION") continue;
      if (Status status = AddAttribute(name, accessor, base, transform); !status.ok())
        return status;
    }
    return base;
  }

  Status AddAttribute(const std::string& name,
                      int accessor,
                      std::size_t base,
                      const Eigen::Affine3d& transform) {
    const bool is_own = name.size() > 1 && name[0] == '_';
    if (!is_own && name != "NORMAL" && name != "COLOR_0" && name != "TEXCOORD_0") {
      ++skipped_[name];
      return Status::Ok();
    }
    StatusOr<AttributeValues> read = ReadAccessor(model_, accessor);
    if (!read.ok()) return read.status();
    if (read->count != last_count_ || (is_own && read->components != 1)) {
      ++skipped_[name];
      return Status::Ok();
    }
    if (name == "NORMAL" && read->components == 3 && !transform.matrix().isIdentity(0.0)) {
      const Eigen::Matrix3d turn = transform.linear().inverse().transpose();
      for (std::size_t i = 0; i < read->count; ++i) {
        Eigen::Map<Eigen::Vector3d> normal(read->values.data() + 3 * i);
        normal = Eigen::Vector3d(turn * normal).normalized();
      }
    }
    Attribute& attribute = attributes_[name];
    if (attribute.rows == 0) {
      attribute.components = read->components;
      attribute.type = read->type;
      const auto& info = model_.accessors[static_cast<std::size_t>(accessor)];
      attribute.type = TypeOfAccessorName(info.name).value_or(read->type);
    }
    // A part without it comes before: then it is left out as a whole.
    if (attribute.rows != base || attribute.components != read->components) return Status::Ok();
    attribute.rows += read->count;
    attribute.values.insert(attribute.values.end(), read->values.begin(), read->values.end());
    return Status::Ok();
  }

  void AddVertices() {
    PlyElement vertices;
    vertices.name = "vertex";
    vertices.count = positions_.size();
    AppendVectorColumns(
        positions_, {"x", "y", "z"}, is_placed_ ? PlyType::kFloat64 : PlyType::kFloat32, &vertices);
    for (const auto& [name, attribute] : attributes_) {
      if (attribute.rows != vertices.count) {
        document_->warnings.push_back("the attribute " + name +
                                      " left out: not all parts of the scene have it");
      } else if (name == "COLOR_0") {
        AppendColors(attribute.values, attribute.components, &vertices);
      } else {
        AddColumns(name, attribute, &vertices);
      }
    }
    document_->elements.push_back(std::move(vertices));
  }

  struct Attribute {
    std::size_t components = 0;
    std::size_t rows = 0;
    PlyType type = PlyType::kFloat32;
    std::vector<double> values;
  };

  static void AddColumns(const std::string& name, const Attribute& attribute, PlyElement* element) {
    std::vector<std::string> names;
    if (name == "NORMAL") names = {"nx", "ny", "nz"};
    if (name == "TEXCOORD_0") names = {"s", "t"};
    if (names.empty()) names = {name.substr(1)};
    for (std::size_t i = 0; i < std::min(names.size(), attribute.components); ++i) {
      std::string usable;
      for (const char c : names[i]) usable += static_cast<unsigned char>(c) > ' ' ? c : '_';
      if (element->Find(usable) != nullptr) usable += '_';
      PlyProperty column = MakePlyScalar(usable, attribute.type);
      for (std::size_t row = 0; row < attribute.rows; ++row) {
        column.values.push_back(attribute.values[row * attribute.components + i]);
      }
      element->properties.push_back(std::move(column));
    }
  }

  void AddWarnings() {
    for (const auto& [name, count] : skipped_) {
      document_->warnings.push_back("the attribute " + Quoted(name) + " of " +
                                    Counted(count, "part") + " left out");
    }
    const std::array<std::pair<std::size_t, const char*>, 6> others = {
        {{model_.materials.size(), "material"},
         {model_.images.size(), "picture"},
         {model_.animations.size(), "animation"},
         {model_.skins.size(), "skin"},
         {targets_, "morph target"},
         {lines_, "part of lines"}}};
    for (const auto& [count, name] : others) {
      if (count > 0) document_->warnings.push_back(Counted(count, name) + " left out");
    }
  }

  const tinygltf::Model& model_;
  PlyDocument* document_;
  std::size_t met_ = 0;
  bool is_placed_ = false;
  std::vector<Eigen::Vector3d> positions_;
  std::map<std::string, Attribute> attributes_;
  // For the positions of a mesh: the first row and the number of rows.
  std::map<int, std::pair<std::size_t, std::size_t>> base_of_;
  std::size_t last_count_ = 0;
  std::vector<double> corners_;
  std::vector<std::uint32_t> sizes_;
  std::map<std::string, std::size_t> skipped_;
  std::size_t targets_ = 0;
  std::size_t lines_ = 0;
};

// Returns the text in one line without control characters.
std::string OneLine(std::string text) {
  for (char& c : text) c = static_cast<unsigned char>(c) < ' ' || c == 0x7f ? ' ' : c;
  text.erase(text.find_last_not_of(' ') + 1);
  return text.substr(0, 200);
}

}  // namespace

Status ReadGlbFile(const std::string& path, PlyDocument* document) {
  const StatusOr<std::string> bytes = ReadWholeFile(path);
  if (!bytes.ok()) return bytes.status();
  if (bytes->size() > std::numeric_limits<std::uint32_t>::max()) {
    return Status::Error(path + ": more than 4294967295 bytes, which no GLB has");
  }
  // The JSON of a GLB is its first chunk: 12 bytes of the file's head, 8 of the chunk's, the text.
  // Text in the other chunk is data, so that only a length that is wrong makes this look beyond.
  constexpr std::size_t kTextBegin = 20;
  if (bytes->size() > kTextBegin) {
    std::uint32_t length = 0;
    std::memcpy(&length, bytes->data() + 12, sizeof(length));
    Status status = CheckJsonDepth(path, std::string_view(*bytes).substr(kTextBegin, length));
    if (!status.ok()) return status;
  }
  tinygltf::Model model;
  std::string error;
  std::string warning;
  try {
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(IgnorePicture, nullptr);
    const bool is_read =
        loader.LoadBinaryFromMemory(&model,
                                    &error,
                                    &warning,
                                    reinterpret_cast<const unsigned char*>(bytes->data()),
                                    static_cast<unsigned int>(bytes->size()));
    if (!is_read) return Status::Error(path + ": damaged GLB: " + OneLine(error));
    const Status status = SceneReader(model, document).Read();
    return status.ok() ? status : Status::Error(path + ": " + status.message());
  } catch (const std::exception& thrown) {
    return Status::Error(path + ": damaged GLB: " + OneLine(thrown.what()));
  }
}

}  // namespace ceres_ed
