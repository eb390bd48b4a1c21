#include "ceres_ed/geometry/visibility_buffer.h"

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace ceres_ed {
namespace {

// Triangles are cut at this distance in front of the camera, as a fraction of their largest depth.
// Nearer to the camera, projections grow without bound.
constexpr double kNearShare = 1e-6;

// The squares of points: half a side in median spacings, the number of points from which the median
// is taken, and the largest half side in pixels.
constexpr double kSpacings = 1.5;
constexpr std::size_t kSpacingSamples = 1000;
constexpr double kMaxHalfSide = 32.0;

// Returns the median distance of the points to their nearest neighbours; 0 if there are none.
double MedianSpacing(const std::vector<Eigen::Vector3d>& points) {
  const KdTree tree(points);
  const std::size_t step = points.size() / kSpacingSamples + 1;
  std::vector<double> spacings;
  std::array<Neighbor, 2> nearest;
  for (std::size_t i = 0; i < points.size(); i += step) {
    // The first neighbour is the point itself.
    if (tree.KNearest(points[i], 2, nearest.data()) < 2) continue;
    spacings.push_back(std::sqrt(nearest[1].squared_distance));
  }
  return Median(std::move(spacings));
}

}  // namespace

std::optional<std::array<int, 2>> PixelOf(const PinholeCamera& camera,
                                          const Eigen::Vector3d& point) {
  if (!(point.z() > 0.0)) return std::nullopt;
  const Eigen::Vector2d pixel = camera.Project(point);
  const double u = std::floor(pixel.x() + 0.5);
  const double v = std::floor(pixel.y() + 0.5);
  // The test treats NaN as outside. It comes before the conversion, which may overflow.
  if (!(u >= 0.0 && v >= 0.0 && u < camera.width && v < camera.height)) return std::nullopt;
  return std::array<int, 2>{static_cast<int>(u), static_cast<int>(v)};
}

VisibilityBuffer::VisibilityBuffer(const PinholeCamera& camera)
    : camera_(camera), nearest_(camera) {}

void VisibilityBuffer::AddTriangles(const PointCloud& mesh) {
  for (const auto& [a, b, c] : mesh.triangles) {
    const Triangle corners = {mesh.points[a], mesh.points[b], mesh.points[c]};
    const double far = std::max({corners[0].z(), corners[1].z(), corners[2].z()});
    if (!(far > 0.0)) continue;
    const double near = kNearShare * far;
    // Cut the triangle by the plane z = near. The rest has three or four corners.
    std::array<Eigen::Vector3d, 4> kept;
    int count = 0;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d& p = corners[k];
      const Eigen::Vector3d& q = corners[(k + 1) % 3];
      if (p.z() >= near) kept[count++] = p;
      if ((p.z() >= near) != (q.z() >= near)) {
        kept[count++] = p + (near - p.z()) / (q.z() - p.z()) * (q - p);
      }
    }
    for (int k = 2; k < count; ++k) AddTriangle({kept[0], kept[k - 1], kept[k]});
  }
}

void VisibilityBuffer::AddTriangle(const Triangle& corners) {
  std::array<Eigen::Vector2d, 3> p;
  for (int k = 0; k < 3; ++k) p[k] = camera_.Project(corners[k]);
  const auto side = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b, double u, double v) {
    return (b.x() - a.x()) * (v - a.y()) - (b.y() - a.y()) * (u - a.x());
  };
  const double area = side(p[0], p[1], p[2].x(), p[2].y());
  if (area == 0.0 || !std::isfinite(area)) return;
  const auto clamp = [](double value, int size) {
    return static_cast<int>(std::clamp(value, -1.0, static_cast<double>(size)));
  };
  const auto [u_low, u_high] = std::minmax({p[0].x(), p[1].x(), p[2].x()});
  const auto [v_low, v_high] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
  const int u_first = std::max(0, clamp(std::ceil(u_low), camera_.width));
  const int v_first = std::max(0, clamp(std::ceil(v_low), camera_.height));
  const int u_last = std::min(camera_.width - 1, clamp(std::floor(u_high), camera_.width));
  const int v_last = std::min(camera_.height - 1, clamp(std::floor(v_high), camera_.height));
  for (int v = v_first; v <= v_last; ++v) {
    for (int u = u_first; u <= u_last; ++u) {
      const double a = side(p[1], p[2], u, v) / area;
      const double b = side(p[2], p[0], u, v) / area;
      const double c = 1.0 - a - b;
      if (a < 0.0 || b < 0.0 || c < 0.0) continue;
      // 1 / z is linear in the image.
      const double inverse = a / corners[0].z() + b / corners[1].z() + c / corners[2].z();
      nearest_.Add(u, v, 1.0 / inverse);
    }
  }
}

void VisibilityBuffer::AddPoints(const std::vector<Eigen::Vector3d>& points) {
  const double half_side = kSpacings * MedianSpacing(points) * std::max(camera_.fx, camera_.fy);
  for (const Eigen::Vector3d& point : points) {
    const auto pixel = PixelOf(camera_, point);
    if (!pixel) continue;
    const int reach = static_cast<int>(std::min(half_side / point.z(), kMaxHalfSide));
    const int u_last = std::min((*pixel)[0] + reach, camera_.width - 1);
    const int v_last = std::min((*pixel)[1] + reach, camera_.height - 1);
    for (int v = std::max(0, (*pixel)[1] - reach); v <= v_last; ++v) {
      for (int u = std::max(0, (*pixel)[0] - reach); u <= u_last; ++u) {
        nearest_.Add(u, v, point.z());
      }
    }
  }
}

bool VisibilityBuffer::Sees(const Eigen::Vector3d& point, double tolerance) const {
  const auto pixel = PixelOf(camera_, point);
  if (!pixel) return false;
  const double nearest = nearest_.At((*pixel)[0], (*pixel)[1]);
  return point.z() <= nearest + tolerance * point.z();
}

}  // namespace ceres_ed
