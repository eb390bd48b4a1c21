#include "ceres_ed/geometry/spatial_order.h"

#include <ceres_ed/geometry/bounding_box.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// Bits of a code for each axis: three times 21 fit into 64.
constexpr int kBits = 21;

// Moves bit i of the lowest 21 bits to bit 3 i.
std::uint64_t SpreadBits(std::uint64_t value) {
  value = (value | value << 32) & 0x1f00000000ffffULL;
  value = (value | value << 16) & 0x1f0000ff0000ffULL;
  value = (value | value << 8) & 0x100f00f00f00f00fULL;
  value = (value | value << 4) & 0x10c30c30c30c30c3ULL;
  return (value | value << 2) & 0x1249249249249249ULL;
}

template <typename Row>
void Gather(const std::vector<Row>& rows, const std::vector<int>& order, std::vector<Row>* to) {
  to->reserve(rows.size());
  for (const int index : order) to->push_back(rows[static_cast<std::size_t>(index)]);
}

}  // namespace

std::vector<int> SpatialOrder(const std::vector<Eigen::Vector3d>& points) {
  struct Entry {
    std::uint64_t code;
    int index;
  };
  const Eigen::AlignedBox3d box = BoundingBox(points);
  // A cube, so that a cell of the curve is one.
  const double side = points.empty() ? 0.0 : box.sizes().maxCoeff();
  constexpr double kCells = static_cast<double>((1 << kBits) - 1);
  const double scale = side > 0.0 ? kCells / side : 0.0;
  std::vector<Entry> entries;
  entries.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d cell = scale * (points[i] - box.min());
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = std::clamp(cell[axis], 0.0, kCells);
      code |= SpreadBits(static_cast<std::uint64_t>(at)) << axis;
    }
    entries.push_back({code, static_cast<int>(i)});
  }
  // Points of one cell are told apart by their coordinates, and copies of a point by their indices.
  std::sort(entries.begin(), entries.end(), [&points](const Entry& a, const Entry& b) {
    if (a.code != b.code) return a.code < b.code;
    const Eigen::Vector3d& p = points[static_cast<std::size_t>(a.index)];
    const Eigen::Vector3d& q = points[static_cast<std::size_t>(b.index)];
    return std::tie(p[0], p[1], p[2], a.index) < std::tie(q[0], q[1], q[2], b.index);
  });
  std::vector<int> order;
  order.reserve(entries.size());
  for (const Entry& entry : entries) order.push_back(entry.index);
  return order;
}

PointCloud Reordered(const PointCloud& cloud, const std::vector<int>& order) {
  CHECK_EQ(order.size(), cloud.size()) << "one place a point";
  PointCloud sorted;
  Gather(cloud.points, order, &sorted.points);
  if (cloud.HasNormals()) Gather(cloud.normals, order, &sorted.normals);
  if (cloud.HasIntensities()) Gather(cloud.intensities, order, &sorted.intensities);
  sorted.normals_oriented = cloud.normals_oriented;
  const std::vector<int> place = InverseOrder(order);
  sorted.triangles = cloud.triangles;
  for (std::array<int, 3>& triangle : sorted.triangles) {
    for (int& corner : triangle) corner = place[static_cast<std::size_t>(corner)];
    // The corners stay in their direction around the triangle.
    std::rotate(
        triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  }
  std::sort(sorted.triangles.begin(), sorted.triangles.end());
  return sorted;
}

std::vector<int> InverseOrder(const std::vector<int>& order) {
  std::vector<int> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
  }
  return place;
}

}  // namespace ceres_ed
