// Displacements on a regular grid, as other tools take a deformation.
#ifndef CERES_ED_IO_FIELD_DISPLACEMENT_FIELD_H_
#define CERES_ED_IO_FIELD_DISPLACEMENT_FIELD_H_

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A regular grid of points in space. The point with the indices (i, j, k) lies at
//   origin + direction * (spacing_x i, spacing_y j, spacing_z k).
struct FieldGrid {
  // The number of points along each axis, all >= 1.
  std::array<int, 3> size = {1, 1, 1};
  // The position of the point (0, 0, 0), and the distances between neighbours, all > 0, in the unit
  // of the grid.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d spacing = Eigen::Vector3d::Ones();
  // The unit vectors of the axes are its columns.
  Eigen::Matrix3d direction = Eigen::Matrix3d::Identity();

  std::size_t num_points() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  // The index of a point in lists over the grid: i runs fastest.
  std::size_t Index(int i, int j, int k) const {
    const auto row = static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) +
                     static_cast<std::size_t>(j);
    return row * static_cast<std::size_t>(size[0]) + static_cast<std::size_t>(i);
  }
  Eigen::Vector3d Position(int i, int j, int k) const {
    return origin + direction * spacing.cwiseProduct(Eigen::Vector3d(i, j, k));
  }
};

// A displacement for each point of a grid. A point p of the grid is mapped to p plus its
// displacement.
struct DisplacementField {
  FieldGrid grid;
  // Three components for each point, in the order of FieldGrid::Index(), in the frame and unit of
  // the grid. A component may be NaN where the field has no value.
  std::vector<float> vectors;
  // One line for the header of the file, which says what is mapped to what, in which frame and
  // unit. It has printable characters of ASCII only.
  std::string description;
};

}  // namespace ceres_ed

#endif  // CERES_ED_IO_FIELD_DISPLACEMENT_FIELD_H_
