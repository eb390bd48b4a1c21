#include "ceres_ed/geometry/intensity.h"

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/triangle_area.h>

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

// A limit on squared sines of angles and on ratios of variances. Below it, the points lie on a
// line, and the gradient across that line is unknown.
constexpr double kFlat = 1e-10;

const Eigen::Vector3d kUnknown =
    Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());

// Returns the mean gradient of the triangles at each point, weighted by area.
std::vector<Eigen::Vector3d> MeshGradients(const PointCloud& cloud) {
  std::vector<Eigen::Vector3d> sums(cloud.size(), Eigen::Vector3d::Zero());
  std::vector<double> areas(cloud.size(), 0.0);
  const std::vector<double>& intensities = cloud.intensities;
  for (const std::array<int, 3>& t : cloud.triangles) {
    const Eigen::Vector3d& a = cloud.points[t[0]];
    const Eigen::Vector3d& b = cloud.points[t[1]];
    const Eigen::Vector3d& c = cloud.points[t[2]];
    const Eigen::Vector3d gradient =
        GradientOnTriangle(a, b, c, {intensities[t[0]], intensities[t[1]], intensities[t[2]]});
    if (!gradient.allFinite()) continue;
    const double area = AreaVector(a, b, c).norm();
    for (const int corner : t) {
      sums[corner] += area * gradient;
      areas[corner] += area;
    }
  }
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    if (!(areas[p] > 0.0)) {
      sums[p] = kUnknown;
      continue;
    }
    const Eigen::Vector3d mean = sums[p] / areas[p];
    sums[p] = mean - cloud.normals[p] * cloud.normals[p].dot(mean);
  }
  return sums;
}

// Returns the slope of the intensity over the neighbours, along two tangents of the surface.
Eigen::Vector3d SlopeOfNeighbors(const PointCloud& cloud,
                                 int point,
                                 const std::vector<Neighbor>& neighbors) {
  const Eigen::Vector3d& normal = cloud.normals[point];
  if (normal.isZero(0.0) || !std::isfinite(cloud.intensities[point])) return kUnknown;
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  // The fitted plane goes through the mean and not through the point, so that the noise of the
  // point has no more weight than that of its neighbours.
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  int count = 0;
  for (const Neighbor& neighbor : neighbors) {
    const double intensity = cloud.intensities[neighbor.index];
    if (!std::isfinite(intensity)) continue;
    const Eigen::Vector3d offset = cloud.points[neighbor.index] - cloud.points[point];
    const Eigen::Vector3d sample(u.dot(offset), v.dot(offset), intensity);
    mean += sample;
    moments += sample * sample.transpose();
    ++count;
  }
  mean /= count;
  moments -= count * mean * mean.transpose();
  const Eigen::Matrix2d spread = moments.topLeftCorner<2, 2>();
  if (!(spread.determinant() > kFlat * spread.trace() * spread.trace())) return kUnknown;
  const Eigen::Vector2d slope = spread.ldlt().solve(moments.topRightCorner<2, 1>());
  return u * slope[0] + v * slope[1];
}

}  // namespace

Eigen::Vector3d GradientOnTriangle(const Eigen::Vector3d& a,
                                   const Eigen::Vector3d& b,
                                   const Eigen::Vector3d& c,
                                   const std::array<double, 3>& values) {
  const Eigen::Vector3d e = b - a;
  const Eigen::Vector3d f = c - a;
  const double ee = e.squaredNorm();
  const double ff = f.squaredNorm();
  const double ef = e.dot(f);
  const double determinant = ee * ff - ef * ef;
  if (!(determinant > kFlat * ee * ff)) return kUnknown;
  const double along_e = values[1] - values[0];
  const double along_f = values[2] - values[0];
  return ((ff * along_e - ef * along_f) * e + (ee * along_f - ef * along_e) * f) / determinant;
}

std::vector<Eigen::Vector3d> IntensityGradients(const PointCloud& cloud) {
  CHECK(cloud.HasIntensities() && cloud.HasNormals());
  if (cloud.HasTriangles()) return MeshGradients(cloud);
  const KdTree tree(cloud.points);
  std::vector<Eigen::Vector3d> gradients(cloud.size());
  std::vector<Neighbor> neighbors;
  for (int p = 0; p < static_cast<int>(cloud.size()); ++p) {
    tree.KNearest(cloud.points[p], kGradientNeighbors, &neighbors);
    gradients[p] = SlopeOfNeighbors(cloud, p, neighbors);
  }
  return gradients;
}

}  // namespace ceres_ed
