// Point clouds and meshes from files, and back into them with everything else preserved.
#ifndef CERES_ED_IO_CLOUD_IO_H_
#define CERES_ED_IO_CLOUD_IO_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Coordinates of a larger magnitude count as not finite: their squares leave the range of a float.
inline constexpr double kMaxCoordinate = 1e18;

// A cloud, the file that it came from, and what had to be left out.
struct LoadedCloud {
  PointCloud cloud;
  PlyDocument document;
  // The row of element 'vertex' behind each point of `cloud`, ascending.
  std::vector<int> vertex_of_point;
  // One sentence for each kind of thing that was dropped, with its count.
  std::vector<std::string> warnings;
};

// Returns the cloud of the file `path`, a PLY unless its name ends as another format of
// io/mesh/mesh_format.h does: element 'vertex' with x y z of any type; normals from
// nx ny nz or normal_x normal_y normal_z, brought to unit length, a zero or not finite one as zero;
// intensities 0.299 R + 0.587 G + 0.114 B from red green blue, in [0, 1] where they are floats and
// as parts of the largest number where they are integers, NaN where one is not finite;
// triangles from the list vertex_indices or vertex_index of element 'face', polygons as fans.
// Dropped with a warning: points that are not finite and the triangles on them, polygons of fewer
// than three corners, triangles that name a vertex twice. Errors: as of ReadPly; no vertices; no
// x y z; a face index out of range; more than half of the points not finite.
StatusOr<LoadedCloud> LoadCloud(const std::string& path);

// LoadCloud for a document that is in memory; `path` names it in messages.
StatusOr<LoadedCloud> CloudFromDocument(const std::string& path, PlyDocument document);

// Returns `original` with x y z of row vertex_of_point[i] replaced by points[i], and its normal,
// where the original has one and `normals` is not null, by (*normals)[i]. All other rows, elements,
// properties, comments, the order and the format are the original's; types too, but for integer
// coordinates or normals, which become double.
PlyDocument MoveVertices(const PlyDocument& original,
                         const std::vector<int>& vertex_of_point,
                         const std::vector<Eigen::Vector3d>& points,
                         const std::vector<Eigen::Vector3d>* normals);

// Returns ok when `path` holds MoveVertices(original, ...), in the format that its ending names;
// else an error with the system's reason.
Status SaveCloud(const std::string& path,
                 const PlyDocument& original,
                 const std::vector<int>& vertex_of_point,
                 const std::vector<Eigen::Vector3d>& points,
                 const std::vector<Eigen::Vector3d>* normals);

// The same for a cloud as LoadCloud gave it.
Status SaveCloud(const std::string& path,
                 const LoadedCloud& original,
                 const std::vector<Eigen::Vector3d>& points,
                 const std::vector<Eigen::Vector3d>* normals);

struct CloudWriteOptions {
  PlyFormat format = PlyFormat::kBinaryLittleEndian;
  // Positions and normals as double instead of float.
  bool double_precision = false;
  // Lines of text for the header.
  std::vector<std::string> comments;
  // Empty, or red green blue for each point.
  std::vector<std::array<std::uint8_t, 3>> colors;
  // More properties of the vertices, such as `error`: scalar, with one value a point.
  std::vector<PlyProperty> columns;
};

// Returns ok when `path` holds `cloud` (points, normals and triangles where there are any) with the
// columns of `options`; else an error with the system's reason.
Status WriteCloud(const std::string& path,
                  const PointCloud& cloud,
                  const CloudWriteOptions& options = {});

}  // namespace ceres_ed

#endif  // CERES_ED_IO_CLOUD_IO_H_
