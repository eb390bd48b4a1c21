// Points with optional normals, brightness and faces: every surface that the library reads, warps
// or fits.
#ifndef CERES_ED_GEOMETRY_POINT_CLOUD_H_
#define CERES_ED_GEOMETRY_POINT_CLOUD_H_

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A mesh where `triangles` is not empty, else bare points. Lengths are in the unit of the input.
struct PointCloud {
  // One position a point, all finite.
  std::vector<Eigen::Vector3d> points;
  // Empty, or one unit vector a point; zero where no normal could be had (an isolated vertex).
  std::vector<Eigen::Vector3d> normals;
  // False when the normals are known only up to sign (estimated on bare points).
  bool normals_oriented = true;
  // Empty, or the brightness of each point in [0, 1]; NaN where it isn't known.
  std::vector<double> intensities;
  // Counter-clockwise seen from outside; every index is in [0, size()).
  std::vector<std::array<int, 3>> triangles;

  std::size_t size() const { return points.size(); }
  bool empty() const { return points.empty(); }
  bool HasNormals() const { return !normals.empty() && normals.size() == points.size(); }
  bool HasIntensities() const {
    return !intensities.empty() && intensities.size() == points.size();
  }
  bool HasTriangles() const { return !triangles.empty(); }
};

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_POINT_CLOUD_H_
