#include "ceres_ed/geometry/inside_grid.h"

#include <ceres_ed/geometry/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr double kMaxCells = 1 << 24;
// The votes that make a cell an inner one.
constexpr int kMajority = 2;
// The centres of cells are shifted by a part of a cell that is no simple fraction, so that lines do
// not run through the vertices of meshes that were made on a grid.
constexpr double kShift[3] = {0.0137, 0.0271, 0.0193};

double Cross(double ax, double ay, double bx, double by) { return ax * by - ay * bx; }

}  // namespace

InsideGrid::InsideGrid(const PointCloud& cloud, double cell) : cell_(cell), size_{0, 0, 0} {
  CHECK_GT(cell, 0.0);
  origin_.setZero();
  if (cloud.triangles.empty()) return;
  const Eigen::AlignedBox3d box = BoundingBox(cloud.points);
  const Eigen::Vector3d extent = box.sizes();
  // One layer of cells around the surface is outside.
  const auto cells_of = [&extent, this](int axis) { return std::floor(extent[axis] / cell_) + 3; };
  while (cells_of(0) * cells_of(1) * cells_of(2) > kMaxCells) cell_ *= 1.1;
  for (int axis = 0; axis < 3; ++axis) {
    size_[axis] = static_cast<int>(cells_of(axis));
    origin_[axis] = box.min()[axis] - (1.0 + kShift[axis]) * cell_;
  }
  votes_.assign(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2], 0);
  for (int axis = 0; axis < 3; ++axis) Vote(cloud, axis);
}

std::vector<signed char> InsideGrid::Crossings(const PointCloud& cloud, int axis) const {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const int length = size_[axis];
  const std::size_t lines = static_cast<std::size_t>(size_[u]) * size_[v];
  std::vector<signed char> crossings(lines * length, 0);
  const auto center_at = [this](double coordinate, int along) {
    return (coordinate - origin_[along]) / cell_ - 0.5;
  };
  for (const auto& triangle : cloud.triangles) {
    double a[3];
    double b[3];
    double c[3];
    for (int k = 0; k < 3; ++k) {
      a[k] = center_at(cloud.points[triangle[k]][u], u);
      b[k] = center_at(cloud.points[triangle[k]][v], v);
      c[k] = center_at(cloud.points[triangle[k]][axis], axis);
    }
    const double area = Cross(a[1] - a[0], b[1] - b[0], a[2] - a[0], b[2] - b[0]);
    if (area == 0.0) continue;
    const double sign = area > 0.0 ? 1.0 : -1.0;
    const int first_u = static_cast<int>(std::ceil(std::min({a[0], a[1], a[2]})));
    const int last_u = static_cast<int>(std::floor(std::max({a[0], a[1], a[2]})));
    const int first_v = static_cast<int>(std::ceil(std::min({b[0], b[1], b[2]})));
    const int last_v = static_cast<int>(std::floor(std::max({b[0], b[1], b[2]})));
    for (int j = first_v; j <= last_v; ++j) {
      for (int i = first_u; i <= last_u; ++i) {
        double weight[3];
        bool hit = true;
        for (int k = 0; k < 3 && hit; ++k) {
          const int p = (k + 1) % 3;
          const int q = (k + 2) % 3;
          weight[k] = sign * Cross(a[p] - i, b[p] - j, a[q] - i, b[q] - j);
          hit = weight[k] >= 0.0;
        }
        if (!hit) continue;
        const double at = (weight[0] * c[0] + weight[1] * c[1] + weight[2] * c[2]) /
                          (weight[0] + weight[1] + weight[2]);
        const int next = static_cast<int>(std::clamp(std::ceil(at), 0.0, length - 1.0));
        // A triangle whose normal points back along the line is an entrance.
        crossings[(static_cast<std::size_t>(j) * size_[u] + i) * length + next] +=
            area > 0.0 ? -1 : 1;
      }
    }
  }
  return crossings;
}

void InsideGrid::Vote(const PointCloud& cloud, int axis) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const int length = size_[axis];
  const std::vector<signed char> crossings = Crossings(cloud, axis);
  std::array<int, 3> at;
  for (at[v] = 0; at[v] < size_[v]; ++at[v]) {
    for (at[u] = 0; at[u] < size_[u]; ++at[u]) {
      const signed char* line =
          crossings.data() + (static_cast<std::size_t>(at[v]) * size_[u] + at[u]) * length;
      int winding = 0;
      for (at[axis] = 0; at[axis] < length; ++at[axis]) {
        winding += line[at[axis]];
        if (winding != 0) ++votes_[Index(at[0], at[1], at[2])];
      }
    }
  }
}

bool InsideGrid::IsInside(const Eigen::Vector3d& point) const {
  if (votes_.empty()) return false;
  std::array<int, 3> at;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = std::floor((point[axis] - origin_[axis]) / cell_);
    if (!(cell >= 0.0 && cell < size_[axis])) return false;
    at[axis] = static_cast<int>(cell);
  }
  return votes_[Index(at[0], at[1], at[2])] >= kMajority;
}

bool InsideGrid::IsSegmentInside(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
  const double length = (b - a).norm();
  const int steps = static_cast<int>(std::ceil(length / cell_));
  for (int k = 1; k < steps; ++k) {
    const double t = static_cast<double>(k) / steps;
    if (std::min(t, 1.0 - t) * length < cell_) continue;
    if (!IsInside(a + t * (b - a))) return false;
  }
  return true;
}

double InsideGrid::Volume() const {
  std::size_t cells = 0;
  for (const unsigned char votes : votes_) cells += votes >= kMajority;
  return static_cast<double>(cells) * cell_ * cell_ * cell_;
}

}  // namespace ceres_ed
