// The first eigenfunctions of the Laplace-Beltrami operator.
#ifndef CERES_ED_REGISTRATION_INTRINSIC_EIGENFUNCTIONS_H_
#define CERES_ED_REGISTRATION_INTRINSIC_EIGENFUNCTIONS_H_

#include <ceres_ed/registration/intrinsic/laplacian.h>

#include <optional>

#include <Eigen/Core>

namespace ceres_ed {

// The harmonics of a surface, whose area is taken as 1. They depend on lengths along the surface
// alone, so a bend does not change them.
struct SpectralBasis {
  // The eigenvalues of L f = lambda M f in ascending order, for a surface of area 1. The first is
  // about 0.
  Eigen::VectorXd eigenvalues;
  // The eigenfunctions, one in each column, with values at the vertices; f' M f = 1. The first is
  // constant and positive. The signs of the others are arbitrary, and functions with the same
  // eigenvalue may be mixed, but two calls return the same bits.
  Eigen::MatrixXd functions;
  // The masses; they sum to 1.
  Eigen::VectorXd mass;

  int size() const { return static_cast<int>(eigenvalues.size()); }
};

// Returns the first `count` >= 2 eigenfunctions (or fewer, on a surface of fewer than three times
// as many vertices), by Lanczos iterations with the shifted inverse of the operator. Returns
// nothing if they cannot be computed. The surface must be connected.
std::optional<SpectralBasis> ComputeEigenfunctions(const Laplacian& laplacian, int count);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_INTRINSIC_EIGENFUNCTIONS_H_
