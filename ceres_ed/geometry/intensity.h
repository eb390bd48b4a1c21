// How brightness changes along a surface.
#ifndef CERES_ED_GEOMETRY_INTENSITY_H_
#define CERES_ED_GEOMETRY_INTENSITY_H_

#include <ceres_ed/geometry/point_cloud.h>

#include <array>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The number of neighbours to which the gradient at a point without triangles is fitted. The point
// itself is one of them.
inline constexpr int kGradientNeighbors = 12;

// The brightness at a point of a surface.
struct Intensity {
  // The brightness in [0, 1]; NaN where it is unknown.
  double value = std::numeric_limits<double>::quiet_NaN();
  // The gradient along the tangent plane, per unit of length; zero where `value` is unknown.
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};

// Returns the gradient, in the plane of triangle a, b, c, of the linear function that has `values`
// at the corners. It is NaN if a value is NaN or if the triangle has no area.
Eigen::Vector3d GradientOnTriangle(const Eigen::Vector3d& a,
                                   const Eigen::Vector3d& b,
                                   const Eigen::Vector3d& c,
                                   const std::array<double, 3>& values);

// Returns the gradient at each point of `cloud`, per unit of length. The cloud must have
// intensities and normals. On a mesh it is the mean over the triangles at the point, weighted by
// area. Without triangles it is the gradient of a plane that is fitted by least squares to the
// brightness of the nearest neighbours along the tangent plane. It is NaN where it is not
// determined.
std::vector<Eigen::Vector3d> IntensityGradients(const PointCloud& cloud);

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_INTENSITY_H_
