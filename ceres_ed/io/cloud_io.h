// Reads point clouds and meshes from files, and writes them back with everything else preserved.
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

// A coordinate with a larger magnitude counts as not finite, since its square does not fit into a
// float.
inline constexpr double kMaxCoordinate = 1e18;

// A cloud, the file from which it was read, and what was left out.
struct LoadedCloud {
  PointCloud cloud;
  PlyDocument document;
  // For each point of `cloud`, the row of element 'vertex' from which it comes; ascending.
  std::vector<int> vertex_of_point;
  // A sentence for each kind of thing that was left out, with its number.
  std::vector<std::string> warnings;
};

// Reads the cloud of the file `path`, which may be of any format of io/mesh/mesh_format.h. The
// cloud is made of:
//   - Points are x y z of element 'vertex', of any type.
//   - Normals are nx ny nz or normal_x normal_y normal_z, scaled to unit length. A normal that is
//     zero or not finite becomes zero.
//   - Intensities are 0.299 R + 0.587 G + 0.114 B from red green blue, as parts of full brightness
//     (1 for floats, the largest number of an integer type, or what the whole column shows: floats
//     and shorts up to 255 give a warning). An intensity is NaN if a colour is not finite.
//   - Triangles are from the list vertex_indices or vertex_index of element 'face', or else from
//     the strips of 'tristrips'. Polygons are cut into triangles.
//
// The warnings begin with those of the reader. Left out with a warning: points that are not finite
// and their triangles, polygons of fewer than three corners, and triangles that use a vertex twice.
// Errors are those of ReadPly(), and: there are no vertices, there is no x y z, a face index is out
// of range, or no point is finite.
StatusOr<LoadedCloud> LoadCloud(const std::string& path);

// Does the same for a document in memory. `path` names it in messages.
StatusOr<LoadedCloud> CloudFromDocument(const std::string& path, PlyDocument document);

// Returns `original` with new points: x y z of row vertex_of_point[i] becomes points[i], and its
// normal, if the original has normals and `normals` is not null, becomes (*normals)[i]. All other
// rows, elements, properties and comments, the order and the format are not changed. Types are not
// changed either, with two exceptions: integer coordinates or normals become double, and so do the
// coordinates where floats would move a point by more than 1e-5 of the cloud's diagonal (far from
// the origin, for example in UTM).
PlyDocument MoveVertices(const PlyDocument& original,
                         const std::vector<int>& vertex_of_point,
                         const std::vector<Eigen::Vector3d>& points,
                         const std::vector<Eigen::Vector3d>* normals);

// Writes MoveVertices(original, ...) to `path`, in the format of the ending of its name. The error
// gives the system's reason.
Status SaveCloud(const std::string& path,
                 const PlyDocument& original,
                 const std::vector<int>& vertex_of_point,
                 const std::vector<Eigen::Vector3d>& points,
                 const std::vector<Eigen::Vector3d>* normals);

// Does the same for a cloud that was read by LoadCloud().
Status SaveCloud(const std::string& path,
                 const LoadedCloud& original,
                 const std::vector<Eigen::Vector3d>& points,
                 const std::vector<Eigen::Vector3d>* normals);

struct CloudWriteOptions {
  PlyFormat format = PlyFormat::kBinaryLittleEndian;
  // If true, positions and normals are written as double, otherwise as float (but positions that
  // floats cannot hold, far from the origin, always as double).
  bool double_precision = false;
  // Comment lines for the header.
  std::vector<std::string> comments;
  // Empty, or red, green and blue of each point.
  std::vector<std::array<std::uint8_t, 3>> colors;
  // More properties of the vertices, for example `error`: scalars, with one value for each point.
  std::vector<PlyProperty> columns;
  // Unless null, gets a sentence for each kind of thing that the format of the file can't represent
  // (io/mesh/mesh_format.h).
  std::vector<std::string>* losses = nullptr;
};

// Writes `cloud` to `path` (its points, and its normals and triangles if there are any) with the
// columns of `options`. The error gives the system's reason.
Status WriteCloud(const std::string& path,
                  const PointCloud& cloud,
                  const CloudWriteOptions& options = {});

}  // namespace ceres_ed

#endif  // CERES_ED_IO_CLOUD_IO_H_
