// Finds an approximately nearest point of a set in constant time.
#ifndef CERES_ED_REGISTRATION_RIGID_NEAREST_GRID_H_
#define CERES_ED_REGISTRATION_RIGID_NEAREST_GRID_H_

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A grid of cubes around points. Each cube stores the point that is nearest to its centre.
class NearestGrid {
 public:
  // `points` must not be empty. `cell` >= 0 is the edge of the cubes; it is larger if there would
  // be too many cubes. Cubes that have no point within `reach` >= 0 of their centre are empty.
  NearestGrid(const std::vector<Eigen::Vector3d>& points, double cell, double reach);

  // Returns the index of the point that is nearest to the centre of the cube that contains `query`;
  // -1 if the cube is empty or if `query` is outside of the grid.
  int Nearest(const Eigen::Vector3d& query) const {
    const Eigen::Vector3d at = (query - corner_) * per_cell_;
    if (!(at.array() >= 0.0).all() || !(at.array() < size_.cast<double>().array()).all()) return -1;
    return cells_[Cell(at.cast<int>())];
  }

 private:
  std::size_t Cell(const Eigen::Vector3i& at) const {
    return (static_cast<std::size_t>(at[2]) * size_[1] + at[1]) * size_[0] + at[0];
  }

  Eigen::Vector3d corner_;
  double per_cell_;
  Eigen::Vector3i size_;
  std::vector<int> cells_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_RIGID_NEAREST_GRID_H_
