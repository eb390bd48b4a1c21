#include "ceres_ed/report/view/decimation.h"

#include <ceres_ed/geometry/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <set>
#include <unordered_map>
#include <utility>

namespace ceres_ed {
namespace {

// The cells of all points: a number for each point, counted in the order in which cells appear.
struct Cells {
  std::vector<int> of_point;
  int count = 0;
};

Cells FindCells(const std::vector<Eigen::Vector3d>& points,
                const Eigen::AlignedBox3d& box,
                double side) {
  Cells cells;
  cells.of_point.reserve(points.size());
  std::unordered_map<std::uint64_t, int> number;
  for (const Eigen::Vector3d& point : points) {
    // At most 2^20 cells along an axis.
    const Eigen::Matrix<std::uint64_t, 3, 1> at =
        ((point - box.min()) / side).array().floor().cast<std::uint64_t>();
    const std::uint64_t key = (at.x() << 42U) | (at.y() << 21U) | at.z();
    const auto [entry, is_new] = number.emplace(key, cells.count);
    if (is_new) ++cells.count;
    cells.of_point.push_back(entry->second);
  }
  return cells;
}

// Returns cells of which about `wanted` have points, and never more than 1.1 times as many.
Cells ChooseCells(const std::vector<Eigen::Vector3d>& points, int wanted) {
  constexpr double kMaxCells = 1 << 20;
  constexpr int kMaxTrials = 12;
  const Eigen::AlignedBox3d box = BoundingBox(points);
  const double diagonal = box.diagonal().norm();
  if (!(diagonal > 0.0)) return {std::vector<int>(points.size(), 0), 1};
  // The number of cells on a surface falls with the square of their side.
  double side = std::max(diagonal / kMaxCells, diagonal / std::sqrt(2.0 * wanted));
  Cells cells = FindCells(points, box, side);
  for (int trial = 0; trial < kMaxTrials; ++trial) {
    const double ratio = static_cast<double>(cells.count) / wanted;
    if (ratio > 0.85 && ratio <= 1.1) return cells;
    side *= std::clamp(std::sqrt(ratio), 0.25, 4.0);
    if (side <= diagonal / kMaxCells) break;
    cells = FindCells(points, box, side);
  }
  // Points in a solid or on a line: coarser cells until there are few enough.
  while (cells.count > 1.1 * wanted) {
    side *= 1.3;
    cells = FindCells(points, box, side);
  }
  return cells;
}

// Returns the point of each cell that is nearest to the mean of the points in the cell.
std::vector<int> ChoosePoints(const std::vector<Eigen::Vector3d>& points, const Cells& cells) {
  std::vector<Eigen::Vector3d> means(cells.count, Eigen::Vector3d::Zero());
  std::vector<int> sizes(cells.count, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    means[cells.of_point[i]] += points[i];
    ++sizes[cells.of_point[i]];
  }
  for (int c = 0; c < cells.count; ++c) means[c] /= sizes[c];
  std::vector<int> chosen(cells.count, -1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int cell = cells.of_point[i];
    int& best = chosen[cell];
    if (best < 0 ||
        (points[i] - means[cell]).squaredNorm() < (points[best] - means[cell]).squaredNorm()) {
      best = static_cast<int>(i);
    }
  }
  return chosen;
}

}  // namespace

Decimation Decimate(const std::vector<Eigen::Vector3d>& points,
                    const std::vector<std::array<int, 3>>& triangles,
                    int max_points,
                    const std::vector<int>& must_keep) {
  Decimation result;
  if (points.size() <= static_cast<std::size_t>(max_points)) {
    result.kept.resize(points.size());
    std::iota(result.kept.begin(), result.kept.end(), 0);
    result.triangles = triangles;
    return result;
  }
  const Cells cells = ChooseCells(points, max_points);
  const std::vector<int> chosen = ChoosePoints(points, cells);
  result.kept = chosen;
  result.kept.insert(result.kept.end(), must_keep.begin(), must_keep.end());
  std::sort(result.kept.begin(), result.kept.end());
  result.kept.erase(std::unique(result.kept.begin(), result.kept.end()), result.kept.end());
  std::vector<int> of_cell(cells.count);
  for (int c = 0; c < cells.count; ++c) {
    of_cell[c] = static_cast<int>(
        std::lower_bound(result.kept.begin(), result.kept.end(), chosen[c]) - result.kept.begin());
  }
  std::set<std::array<int, 3>> seen;
  for (const std::array<int, 3>& triangle : triangles) {
    std::array<int, 3> corners{};
    for (int k = 0; k < 3; ++k) corners[k] = of_cell[cells.of_point[triangle[k]]];
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    std::array<int, 3> sorted = corners;
    std::sort(sorted.begin(), sorted.end());
    if (seen.insert(sorted).second) result.triangles.push_back(corners);
  }
  return result;
}

}  // namespace ceres_ed
