#include "ceres_ed/registration/intrinsic/tangent_triangles.h"

#include <ceres_ed/geometry/kd_tree.h>

#include <cmath>
#include <utility>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

// Neighbours are searched within this many spacings.
constexpr double kReach = 3.0;
// No circle around a triangle has a radius of more spacings.
constexpr double kMaxRadius = 1.5;
// A neighbour whose normal agrees less than this (cosine) lies on another sheet.
constexpr double kLeastAgreement = 0.3;

// A corner of a cell in the plane, and the neighbour that bounds the side that begins there; -1 is
// the frame from which the cell is cut.
struct CellCorner {
  Eigen::Vector2d at;
  int neighbor = -1;
};

// Cuts away what is nearer to `other` than to the origin.
void CutCell(const Eigen::Vector2d& other, int neighbor, std::vector<CellCorner>* cell) {
  const double half = 0.5 * other.squaredNorm();
  std::vector<CellCorner> kept;
  const std::size_t n = cell->size();
  for (std::size_t i = 0; i < n; ++i) {
    const CellCorner& a = (*cell)[i];
    const CellCorner& b = (*cell)[(i + 1) % n];
    const double beyond_a = a.at.dot(other) - half;
    const double beyond_b = b.at.dot(other) - half;
    if (beyond_a <= 0.0) kept.push_back(a);
    if ((beyond_a <= 0.0) == (beyond_b <= 0.0)) continue;
    const double part = beyond_a / (beyond_a - beyond_b);
    // Where the side leaves the half-plane, the new side begins; where it enters again, the old one
    // goes on.
    kept.push_back({a.at + part * (b.at - a.at), beyond_a <= 0.0 ? neighbor : a.neighbor});
  }
  *cell = std::move(kept);
}

}  // namespace

std::vector<std::array<int, 3>> TangentTriangles(const std::vector<Eigen::Vector3d>& points,
                                                 const std::vector<Eigen::Vector3d>& normals,
                                                 bool oriented,
                                                 double spacing) {
  std::vector<std::array<int, 3>> triangles;
  const KdTree tree(points);
  std::vector<Neighbor> around;
  std::vector<CellCorner> cell;
  const double frame = kReach * spacing;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    const Eigen::Vector3d& normal = normals[i];
    if (normal.isZero(0.0)) continue;
    const Eigen::Vector3d u = normal.unitOrthogonal();
    const Eigen::Vector3d v = normal.cross(u);
    // The Voronoi cell of the point, cut from a square; its sides are the Delaunay edges.
    cell = {
        {{-frame, -frame}, -1}, {{frame, -frame}, -1}, {{frame, frame}, -1}, {{-frame, frame}, -1}};
    tree.RadiusSearch(points[i], kReach * spacing, &around);
    for (const Neighbor& neighbor : around) {
      const int j = neighbor.index;
      double agreement = normal.dot(normals[j]);
      if (!oriented) agreement = std::abs(agreement);
      if (j == i || agreement < kLeastAgreement) continue;
      const Eigen::Vector3d d = points[j] - points[i];
      Eigen::Vector2d flat(d.dot(u), d.dot(v));
      // The distance is kept: a point on the side of a thin limb is not nearer than it is.
      const double length = flat.norm();
      if (!(length > 0.0)) continue;
      flat *= d.norm() / length;
      CutCell(flat, j, &cell);
    }
    // The corner between the sides of two neighbours is the centre of a triangle's circle.
    for (std::size_t c = 0; c < cell.size(); ++c) {
      const int before = cell[(c + cell.size() - 1) % cell.size()].neighbor;
      const int after = cell[c].neighbor;
      const bool is_near = cell[c].at.norm() < kMaxRadius * spacing;
      if (before >= 0 && after >= 0 && before != after && is_near) {
        triangles.push_back({i, before, after});
      }
    }
  }
  return triangles;
}

}  // namespace ceres_ed
