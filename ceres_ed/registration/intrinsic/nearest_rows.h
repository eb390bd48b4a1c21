// Nearest rows of two matrices, by comparing all with all.
#ifndef CERES_ED_REGISTRATION_INTRINSIC_NEAREST_ROWS_H_
#define CERES_ED_REGISTRATION_INTRINSIC_NEAREST_ROWS_H_

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The images of vertices: vertices of the other surface.
using Images = std::vector<int>;

// A map between two surfaces in both directions.
struct PointMap {
  // A target vertex for each of some source vertices, and a source vertex for each of some target
  // vertices.
  Images forth;
  Images back;
};

// Returns for each row of `a` the nearest row of `b`, and the other way round; the lowest index of
// equals. Distances have the precision of single numbers. Both matrices must have rows, and the
// same number of columns. With many columns this is faster than a search tree.
PointMap NearestRows(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_INTRINSIC_NEAREST_ROWS_H_
