#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/mesh/byte_order.h>
#include <ceres_ed/io/mesh/face_groups.h>
#include <ceres_ed/io/mesh/mesh_space.h>
#include <ceres_ed/io/mesh/mesh_view.h>
#include <ceres_ed/io/mesh/stl_file.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

template <typename T>
void AppendBytes(T number, std::string* bytes) {
  std::array<char, sizeof(T)> own;
  std::memcpy(own.data(), &number, sizeof(T));
  if (!HostIsLittleEndian()) std::reverse(own.begin(), own.end());
  bytes->append(own.data(), own.size());
}

// A triangle of the file: its normal and its corners.
struct Facet {
  std::array<Eigen::Vector3f, 4> vectors;
};

Facet FacetOf(const MeshView& view, const std::array<std::size_t, 3>& corners) {
  std::array<Eigen::Vector3d, 3> points;
  for (std::size_t i = 0; i < 3; ++i) points[i] = view.Point(corners[i]);
  const Eigen::Vector3d normal = (points[1] - points[0]).cross(points[2] - points[0]);
  const double length = normal.stableNorm();
  Facet facet;
  facet.vectors[0].setZero();
  if (std::isfinite(length) && length > 0.0) facet.vectors[0] = (normal / length).cast<float>();
  for (std::size_t i = 0; i < 3; ++i) facet.vectors[i + 1] = points[i].cast<float>();
  return facet;
}

// Returns the 16 bits of a face; 0 if it has none.
std::uint16_t AttributeOf(const PlyElement& faces, std::size_t face) {
  const PlyProperty* const attributes = faces.Find("attribute");
  if (attributes == nullptr || attributes->is_list) return 0;
  const double bits = attributes->values[face];
  return bits > 0.0 && bits <= 65535.0 ? static_cast<std::uint16_t>(bits) : std::uint16_t{0};
}

std::string Binary(const PlyDocument& document, const MeshView& view) {
  std::string triangles;
  std::uint32_t count = 0;
  for (std::size_t face = 0; face < view.NumFaces(); ++face) {
    for (const std::array<std::size_t, 3>& corners : view.TrianglesOf(face)) {
      for (const Eigen::Vector3f& vector : FacetOf(view, corners).vectors) {
        for (const float value : vector) AppendBytes(value, &triangles);
      }
      AppendBytes(AttributeOf(*view.faces(), face), &triangles);
      ++count;
    }
  }
  std::string bytes = "binary STL, written by ceres_ed " + std::string(SpaceMarkOf(document));
  bytes.resize(80, ' ');
  AppendBytes(count, &bytes);
  return bytes + triangles;
}

void AppendLine(const char* words, const Eigen::Vector3f& vector, std::string* text) {
  *text += words;
  for (const float value : vector) {
    std::array<char, 32> digits;
    *text += ' ';
    text->append(digits.data(), std::to_chars(digits.data(), digits.data() + 32, value).ptr);
  }
  *text += '\n';
}

std::string Ascii(const PlyDocument& document, const MeshView& view) {
  const FaceGroups groups = FaceGroups::Of(document);
  std::string name = groups.GroupOf(0).names[0];
  const std::string_view mark = SpaceMarkOf(document);
  if (FindSpaceMark(name).empty() && !mark.empty()) name += ' ' + std::string(mark);
  std::string text = "solid " + name + '\n';
  for (std::size_t face = 0; face < view.NumFaces(); ++face) {
    if (const std::string& own = groups.GroupOf(face).names[0];
        own != groups.GroupOf(face == 0 ? 0 : face - 1).names[0]) {
      text += "endsolid " + name + "\nsolid " + own + '\n';
      name = own;
    }
    for (const std::array<std::size_t, 3>& corners : view.TrianglesOf(face)) {
      const Facet facet = FacetOf(view, corners);
      AppendLine("facet normal", facet.vectors[0], &text);
      text += "outer loop\n";
      for (std::size_t i = 1; i <= 3; ++i) AppendLine("vertex", facet.vectors[i], &text);
      text += "endloop\nendfacet\n";
    }
  }
  return text + "endsolid " + name + '\n';
}

}  // namespace

Status WriteStl(const std::string& path, const PlyDocument& document) {
  const StatusOr<MeshView> view = MeshView::Of(path, document);
  if (!view.ok()) return view.status();
  if (view->NumFaces() == 0) {
    return Status::Error(path +
                         ": an STL file holds triangles alone, and there are no faces, expected a "
                         "name that ends in .ply");
  }
  return WriteFileAtomically(
      path,
      document.format == PlyFormat::kAscii ? Ascii(document, *view) : Binary(document, *view));
}

}  // namespace ceres_ed
