#include "ceres_ed/registration/rigid/nearest_grid.h"

#include <ceres_ed/geometry/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ceres_ed {
namespace {

constexpr double kMaxCellsPerAxis = 120.0;

}  // namespace

NearestGrid::NearestGrid(const std::vector<Eigen::Vector3d>& points, double cell, double reach) {
  const Eigen::AlignedBox3d box = BoundingBox(points);
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(reach);
  const Eigen::Vector3d extent = box.sizes() + 2.0 * margin;
  cell = std::max(cell, extent.maxCoeff() / kMaxCellsPerAxis);
  // All points are at one place, and there is no reach: one cube of any size has them.
  if (!(cell > 0.0)) cell = 1.0;
  corner_ = box.min() - margin;
  per_cell_ = 1.0 / cell;
  size_ = (extent * per_cell_).array().ceil().max(1.0).cast<int>();
  const std::size_t num_cells = static_cast<std::size_t>(size_[0]) * size_[1] * size_[2];
  cells_.assign(num_cells, -1);
  std::vector<float> best(num_cells, std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < points.size(); ++i) {
    // In units of cells, where the centre of cell k is at k + 0.5.
    const Eigen::Vector3d at = (points[i] - corner_) * per_cell_ - Eigen::Vector3d::Constant(0.5);
    const double radius = reach * per_cell_;
    const Eigen::Vector3i low = (at.array() - radius).ceil().max(0.0).cast<int>();
    const Eigen::Vector3i high = (at.array() + radius).floor().cast<int>().min(size_.array() - 1);
    for (int z = low[2]; z <= high[2]; ++z) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int x = low[0]; x <= high[0]; ++x) {
          const auto squared = static_cast<float>((Eigen::Vector3d(x, y, z) - at).squaredNorm());
          if (squared > static_cast<float>(radius * radius)) continue;
          const std::size_t index = Cell({x, y, z});
          if (squared >= best[index]) continue;
          best[index] = squared;
          cells_[index] = static_cast<int>(i);
        }
      }
    }
  }
}

}  // namespace ceres_ed
