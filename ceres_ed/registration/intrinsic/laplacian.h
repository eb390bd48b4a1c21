// The Laplace-Beltrami operator of a triangulated surface.
#ifndef CERES_ED_REGISTRATION_INTRINSIC_LAPLACIAN_H_
#define CERES_ED_REGISTRATION_INTRINSIC_LAPLACIAN_H_

#include <array>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace ceres_ed {

// The operator M^-1 L with linear elements on triangles. L is positive semidefinite, and constants
// are its kernel on a connected surface.
struct Laplacian {
  // The lower triangle of L, compressed, with a full diagonal: -(cot a + cot b) / 2 for an edge
  // with the opposite angles a and b, and minus the sum of its row on the diagonal. No unit.
  Eigen::SparseMatrix<double> stiffness;
  // The lumped masses, the diagonal of M: a third of the area around each vertex, in the squared
  // unit of the points; all > 0.
  Eigen::VectorXd mass;
};

// Returns the operator of a triangulation. It may be non-manifold, and triangles may occur several
// times: each counts with `triangle_weight` > 0. Weights of edges that would be negative (opposite
// angles of more than 180 degrees together) are raised to a small positive value, and so are the
// masses of vertices without triangles. There must be a triangle with an area.
Laplacian BuildLaplacian(const std::vector<Eigen::Vector3d>& points,
                         const std::vector<std::array<int, 3>>& triangles,
                         double triangle_weight = 1.0);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_INTRINSIC_LAPLACIAN_H_
