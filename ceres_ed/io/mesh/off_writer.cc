#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/mesh/mesh_view.h>
#include <ceres_ed/io/mesh/off_file.h>
#include <ceres_ed/io/text_rows.h>

#include <algorithm>
#include <cstddef>
#include <optional>

namespace ceres_ed {
namespace {

// Returns a share of the largest colour within [0, 1], beyond which it would be read as a byte; not
// a number is black.
double WithinColors(double share) { return share > 0.0 ? std::min(share, 1.0) : 0.0; }

// Appends red green blue alpha: bytes as they are, other types in [0, 1].
void AppendColor(const PlyElement& element,
                 const ColorColumns& colors,
                 std::size_t row,
                 std::string* text) {
  const PlyType type = element.properties[colors.rgb[0]].type;
  const bool is_byte = type == PlyType::kUint8;
  for (const std::size_t column : colors.rgb) {
    const PlyProperty& channel = element.properties[column];
    const double share = WithinColors(channel.values[row] / LargestColor(channel.type));
    AppendNumbers({is_byte ? channel.values[row] : share}, text);
  }
  if (!colors.alpha.has_value()) return AppendNumbers({is_byte ? 255.0 : 1.0}, text);
  const PlyProperty& alpha = element.properties[*colors.alpha];
  const double share = WithinColors(alpha.values[row] / LargestColor(alpha.type));
  AppendNumbers({is_byte ? 255.0 * share : share}, text);
}

}  // namespace

Status WriteOff(const std::string& path, const PlyDocument& document) {
  const StatusOr<MeshView> view = MeshView::Of(path, document);
  if (!view.ok()) return view.status();
  const PlyElement& vertices = view->vertices();
  const std::optional<VertexColumns> normals = FindNormalColumns(vertices);
  const std::optional<ColorColumns> colors = FindColors(vertices);
  std::string text =
      std::string(colors.has_value() ? "C" : "") + (normals.has_value() ? "N" : "") + "OFF\n";
  for (const std::string& comment : document.comments) text += "# " + CommentLine(comment) + '\n';
  text += std::to_string(vertices.count) + ' ' + std::to_string(view->NumFaces()) + " 0\n";
  for (std::size_t row = 0; row < vertices.count; ++row) {
    const Eigen::Vector3d point = view->Point(row);
    AppendNumbers({point.x(), point.y(), point.z()}, &text);
    if (normals.has_value()) {
      const Eigen::Vector3d normal = RowOf(vertices, *normals, row);
      AppendNumbers({normal.x(), normal.y(), normal.z()}, &text);
    }
    if (colors.has_value()) AppendColor(vertices, *colors, row, &text);
    text += '\n';
  }
  const std::optional<ColorColumns> face_colors =
      view->faces() == nullptr ? std::nullopt : FindColors(*view->faces());
  for (std::size_t face = 0; face < view->NumFaces(); ++face) {
    text += std::to_string(view->FaceSize(face));
    for (std::size_t i = 0; i < view->FaceSize(face); ++i) {
      text += ' ' + std::to_string(view->Corner(face, i));
    }
    if (face_colors.has_value()) AppendColor(*view->faces(), *face_colors, face, &text);
    text += '\n';
  }
  return WriteFileAtomically(path, text);
}

}  // namespace ceres_ed
