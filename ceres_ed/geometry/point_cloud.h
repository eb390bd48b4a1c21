// Points with optional normals, brightness and triangles. Every surface that the library reads,
// warps or fits has this type.
#ifndef CERES_ED_GEOMETRY_POINT_CLOUD_H_
#define CERES_ED_GEOMETRY_POINT_CLOUD_H_

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A mesh if `triangles` is not empty, otherwise points without triangles. Lengths are in the unit
// of the input.
struct PointCloud {
  // The positions of the points. All are finite.
  std::vector<Eigen::Vector3d> points;
  // Empty, or one unit vector for each point. It is zero where the normal is unknown (for example
  // at an isolated vertex).
  std::vector<Eigen::Vector3d> normals;
  // False if the normals are known only up to sign (when they were estimated without triangles).
  bool normals_oriented = true;
  // Empty, or the brightness of each point in [0, 1]. It is NaN where it is unknown.
  std::vector<double> intensities;
  // The corners of each triangle, counter-clockwise as seen from outside. Every index is in [0,
  // size()).
  std::vector<std::array<int, 3>> triangles;

  std::size_t size() const { return points.size(); }
  bool empty() const { return points.empty(); }
  bool HasNormals() const { return !normals.empty() && normals.size() == points.size(); }
  bool HasIntensities() const {
    return !intensities.empty() && intensities.size() == points.size();
  }
  bool HasTriangles() const { return !triangles.empty(); }
};

// A point of a cloud, and the position at which it belongs.
struct Landmark {
  // The index of the point in the cloud.
  int point = -1;
  // The position, in the frame and unit of the target.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_POINT_CLOUD_H_
