// Looks at a document as a mesh: its points, its faces, and the columns that formats other than PLY
// know.
#ifndef CERES_ED_IO_MESH_MESH_VIEW_H_
#define CERES_ED_IO_MESH_MESH_VIEW_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/io/mesh/vertex_columns.h>
#include <ceres_ed/util/status.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Points into a document, which must live longer and must not change.
class MeshView {
 public:
  // Returns an error that begins with `path` if the document has no vertices with x y z, or a face
  // names a vertex that is not there.
  static StatusOr<MeshView> Of(const std::string& path, const PlyDocument& document);

  const PlyElement& vertices() const { return *vertices_; }
  // Null if there are no faces.
  const PlyElement* faces() const { return faces_; }
  std::size_t NumFaces() const { return faces_ == nullptr ? 0 : faces_->count; }
  Eigen::Vector3d Point(std::size_t row) const { return RowOf(*vertices_, positions_, row); }
  bool HasDoubles() const;

  std::size_t FaceSize(std::size_t face) const { return begins_[face + 1] - begins_[face]; }
  // Returns the row of the vertex at a corner.
  std::size_t Corner(std::size_t face, std::size_t corner) const {
    return static_cast<std::size_t>(corners_->values[begins_[face] + corner]);
  }
  // Returns the triangles of a face, as rows of vertices; none for fewer than three corners.
  std::vector<std::array<std::size_t, 3>> TrianglesOf(std::size_t face) const;

 private:
  MeshView() = default;

  const PlyElement* vertices_ = nullptr;
  const PlyElement* faces_ = nullptr;
  const PlyProperty* corners_ = nullptr;
  VertexColumns positions_ = {};
  // The first corner of each face, and the number of corners.
  std::vector<std::size_t> begins_;
};

// Returns the list of the corners of faces, or null.
const PlyProperty* FindCorners(const PlyElement& faces);

// The columns red green blue of an element, and alpha if it is there.
struct ColorColumns {
  VertexColumns rgb = {};
  std::optional<std::size_t> alpha;
};
std::optional<ColorColumns> FindColors(const PlyElement& element);

// Returns the value of the brightest colour in a column of `type`: 255 for a uchar, 1 for a float.
double LargestColor(PlyType type);

// Appends an element `face` with the list vertex_indices. `sizes` has the number of corners of each
// face.
void AppendFaces(std::vector<double> corners,
                 std::vector<std::uint32_t> sizes,
                 PlyDocument* document);

// Appends columns red green blue (and alpha, for four channels a row) with values in [0, 1]. If all
// are multiples of 1/255, as most are, they become bytes.
void AppendColors(const std::vector<double>& values, std::size_t channels, PlyElement* element);

// Returns `comment` with blanks for ends of lines, behind which readers would take it for data.
std::string CommentLine(std::string comment);

// Returns "1 point" or "5 points".
std::string Counted(std::size_t count, const std::string& noun);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_MESH_VIEW_H_
