#include "ceres_ed/geometry/closest_point.h"

#include <algorithm>
#include <array>
#include <limits>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

// A triangle flatter than this ratio of height to width has no well-defined plane. The closest
// point is then searched on its edges.
constexpr double kFlatness = 1e-10;

// Returns where the point of segment a b closest to `query` lies: 0 at a, 1 at b.
double ClosestFraction(const Eigen::Vector3d& query,
                       const Eigen::Vector3d& a,
                       const Eigen::Vector3d& b) {
  const double squared_length = (b - a).squaredNorm();
  if (!(squared_length > 0.0)) return 0.0;
  return std::clamp((query - a).dot(b - a) / squared_length, 0.0, 1.0);
}

// Returns the barycentric coordinates of the closest point on the three edges.
Eigen::Vector3d ClosestOnEdges(const Eigen::Vector3d& query,
                               const std::array<const Eigen::Vector3d*, 3>& corners) {
  Eigen::Vector3d best = Eigen::Vector3d::UnitX();
  double best_distance = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double t = ClosestFraction(query, *corners[i], *corners[j]);
    const double distance = (query - (*corners[i] + t * (*corners[j] - *corners[i]))).squaredNorm();
    if (distance >= best_distance) continue;
    best_distance = distance;
    best.setZero();
    best[i] = 1.0 - t;
    best[j] = t;
  }
  return best;
}

}  // namespace

// Finds the Voronoi region of the triangle in which the query lies (Ericson, Real-Time Collision
// Detection, 5.1.5).
Eigen::Vector3d ClosestPointOnTriangle(const Eigen::Vector3d& query,
                                       const Eigen::Vector3d& a,
                                       const Eigen::Vector3d& b,
                                       const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a;
  const double widest = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  if (!(ab.cross(ac).squaredNorm() > kFlatness * kFlatness * widest * widest))
    return ClosestOnEdges(query, {&a, &b, &c});
  const Eigen::Vector3d aq = query - a;
  const double d1 = ab.dot(aq), d2 = ac.dot(aq);
  if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
  const Eigen::Vector3d bq = query - b;
  const double d3 = ab.dot(bq), d4 = ac.dot(bq);
  if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double t = d1 / (d1 - d3);
    return {1.0 - t, t, 0.0};
  }
  const Eigen::Vector3d cq = query - c;
  const double d5 = ab.dot(cq), d6 = ac.dot(cq);
  if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double t = d2 / (d2 - d6);
    return {1.0 - t, 0.0, t};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0.0, 1.0 - t, t};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

}  // namespace ceres_ed
