// How brightness changes along a surface.
#ifndef CERES_ED_GEOMETRY_INTENSITY_H_
#define CERES_ED_GEOMETRY_INTENSITY_H_

#include <ceres_ed/geometry/point_cloud.h>

#include <array>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Neighbours of a bare point that its gradient is fitted to, itself included.
inline constexpr int kGradientNeighbors = 12;

// Brightness at a place of a surface.
struct Intensity {
  // In [0, 1]; NaN where it isn't known.
  double value = std::numeric_limits<double>::quiet_NaN();
  // Along the tangent plane, per unit of length; zero where `value` isn't known.
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};

// The gradient, in the plane of triangle a, b, c, of what is linear on it and has `values` at its
// corners. NaN where a value is, or where the triangle has no area.
Eigen::Vector3d GradientOnTriangle(const Eigen::Vector3d& a,
                                   const Eigen::Vector3d& b,
                                   const Eigen::Vector3d& c,
                                   const std::array<double, 3>& values);

// The gradient at each point of `cloud`, which has intensities and normals: the mean over the
// triangles at it by area, or on bare points that of the plane through the brightness of its
// nearest neighbours, by least squares along the tangent plane. NaN where it isn't determined.
std::vector<Eigen::Vector3d> IntensityGradients(const PointCloud& cloud);

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_INTENSITY_H_
