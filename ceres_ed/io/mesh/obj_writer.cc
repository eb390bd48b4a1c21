#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/mesh/face_groups.h>
#include <ceres_ed/io/mesh/mesh_view.h>
#include <ceres_ed/io/mesh/obj_file.h>
#include <ceres_ed/io/text_rows.h>

#include <array>
#include <cstddef>
#include <optional>

namespace ceres_ed {
namespace {

class ObjWriter {
 public:
  ObjWriter(const PlyDocument& document, const MeshView& view) : document_(document), view_(view) {}

  std::string Write() {
    for (const std::string& comment : document_.comments) {
      const bool is_library = comment.rfind("mtllib ", 0) == 0;
      text_ += (is_library ? "" : "# ") + CommentLine(comment) + '\n';
    }
    WriteVertices();
    WriteTextures();
    WriteFaces();
    WriteEdges();
    return std::move(text_);
  }

 private:
  void WriteVertices() {
    const PlyElement& vertices = view_.vertices();
    const std::optional<ColorColumns> colors = FindColors(vertices);
    const std::optional<VertexColumns> normals = FindNormalColumns(vertices);
    for (std::size_t row = 0; row < vertices.count; ++row) {
      const Eigen::Vector3d point = view_.Point(row);
      text_ += "v ";
      AppendNumbers({point.x(), point.y(), point.z()}, &text_);
      for (std::size_t i = 0; colors.has_value() && i < 3; ++i) {
        const PlyProperty& channel = vertices.properties[colors->rgb[i]];
        AppendNumbers({channel.values[row] / LargestColor(channel.type)}, &text_);
      }
      text_ += '\n';
    }
    has_normals_ = normals.has_value();
    for (std::size_t row = 0; has_normals_ && row < vertices.count; ++row) {
      const Eigen::Vector3d normal = RowOf(vertices, *normals, row);
      text_ += "vn ";
      AppendNumbers({normal.x(), normal.y(), normal.z()}, &text_);
      text_ += '\n';
    }
  }

  void WriteTextures() {
    const PlyElement* const element = document_.Find("texture_vertex");
    if (element == nullptr || view_.faces() == nullptr) return;
    const PlyProperty* const list = view_.faces()->Find("texture_indices");
    if (list == nullptr || !list->is_list || IsFloatingPlyType(list->type)) return;
    if (element->Find("u") == nullptr) return;
    textures_ = list;
    for (std::size_t row = 0; row < element->count; ++row) {
      text_ += "vt ";
      for (const PlyProperty& column : element->properties) {
        if (!column.is_list) AppendNumbers({column.values[row]}, &text_);
      }
      text_ += '\n';
    }
  }

  void WriteFaces() {
    const FaceGroups groups = FaceGroups::Of(document_);
    FaceGroup written;
    std::size_t texture = 0;
    for (std::size_t face = 0; face < view_.NumFaces(); ++face) {
      WriteGroup(groups.GroupOf(face), &written);
      const std::size_t size = view_.FaceSize(face);
      const std::size_t num_textures = textures_ == nullptr ? 0 : textures_->list_sizes[face];
      text_ += 'f';
      for (std::size_t i = 0; i < size; ++i) {
        const std::string vertex = std::to_string(view_.Corner(face, i) + 1);
        text_ += ' ' + vertex;
        if (num_textures == size) {
          text_ += '/' + std::to_string(static_cast<long>(textures_->values[texture + i]) + 1);
        }
        if (has_normals_) text_ += (num_textures == size ? "/" : "//") + vertex;
      }
      texture += num_textures;
      text_ += '\n';
    }
  }

  void WriteGroup(const FaceGroup& group, FaceGroup* written) {
    for (std::size_t i = 0; i < group.names.size(); ++i) {
      if (group.names[i] == written->names[i]) continue;
      text_ += std::string(FaceGroup::kKeywords[i]) + ' ' + group.names[i] + '\n';
    }
    *written = group;
  }

  void WriteEdges() {
    const PlyElement* const edges = document_.Find("edge");
    if (edges == nullptr) return;
    const PlyProperty* const from = edges->Find("vertex1");
    const PlyProperty* const to = edges->Find("vertex2");
    if (from == nullptr || to == nullptr || from->is_list || to->is_list) return;
    if (IsFloatingPlyType(from->type) || IsFloatingPlyType(to->type)) return;
    for (std::size_t row = 0; row < edges->count; ++row) {
      text_ += "l " + std::to_string(static_cast<long>(from->values[row]) + 1) + ' ' +
               std::to_string(static_cast<long>(to->values[row]) + 1) + '\n';
    }
  }

  const PlyDocument& document_;
  const MeshView& view_;
  std::string text_;
  bool has_normals_ = false;
  // The texture vertices of the corners; null if there are none.
  const PlyProperty* textures_ = nullptr;
};

}  // namespace

Status WriteObj(const std::string& path, const PlyDocument& document) {
  const StatusOr<MeshView> view = MeshView::Of(path, document);
  if (!view.ok()) return view.status();
  return WriteFileAtomically(path, ObjWriter(document, *view).Write());
}

}  // namespace ceres_ed
