// Clouds and meshes of the Point Cloud Library for fits, and results back into them. Link
// ceres_ed::pcl, the component `pcl` of find_package(ceres_ed).
#ifndef CERES_ED_PCL_PCL_CONVERSIONS_H_
#define CERES_ED_PCL_PCL_CONVERSIONS_H_

#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/util/status.h>

#include <vector>

#include <Eigen/Core>
#include <pcl/PCLPointCloud2.h>
#include <pcl/PolygonMesh.h>
#include <pcl/conversions.h>
#include <pcl/point_cloud.h>

namespace ceres_ed {

// Returns the cloud as LoadCloud returns that of a file: points that are not finite are left out
// with a warning, normals come from normal_x normal_y normal_z, brightness from `rgb` or `rgba`,
// and all fields are kept in the document. Errors as of LoadCloud, and for integers of 64 bits.
StatusOr<LoadedCloud> FromPcl(const pcl::PCLPointCloud2& cloud);

// The same for a mesh: its polygons become triangles. A polygon that names no vertex is an error.
StatusOr<LoadedCloud> FromPcl(const pcl::PolygonMesh& mesh);

// The same for a cloud of any point type that has x y z.
template <typename Point>
StatusOr<LoadedCloud> FromPcl(const pcl::PointCloud<Point>& cloud) {
  pcl::PCLPointCloud2 untyped;
  pcl::toPCLPointCloud2(cloud, untyped);
  return FromPcl(untyped);
}

// Sets `cloud` to what `original` came from, with its points at `points` and its normals, where it
// has some and `normals` is not null, at *normals, as SaveCloud writes them to a file. Points that
// FromPcl left out are still there. Positions and normals are float. Errors: a property of lists
// that differ in length.
Status ToPcl(const LoadedCloud& original,
             const std::vector<Eigen::Vector3d>& points,
             const std::vector<Eigen::Vector3d>* normals,
             pcl::PCLPointCloud2* cloud);

// The same with the faces of the original.
Status ToPcl(const LoadedCloud& original,
             const std::vector<Eigen::Vector3d>& points,
             const std::vector<Eigen::Vector3d>* normals,
             pcl::PolygonMesh* mesh);

// The same as typed points, which keep those fields that the type has.
template <typename Point>
Status ToPcl(const LoadedCloud& original,
             const std::vector<Eigen::Vector3d>& points,
             const std::vector<Eigen::Vector3d>* normals,
             pcl::PointCloud<Point>* cloud) {
  pcl::PCLPointCloud2 untyped;
  Status status = ToPcl(original, points, normals, &untyped);
  if (status.ok()) pcl::fromPCLPointCloud2(untyped, *cloud);
  return status;
}

}  // namespace ceres_ed

#endif  // CERES_ED_PCL_PCL_CONVERSIONS_H_
