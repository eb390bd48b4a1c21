// Maps between two surfaces, as points and as functions.
#ifndef CERES_ED_REGISTRATION_INTRINSIC_FUNCTIONAL_MAP_H_
#define CERES_ED_REGISTRATION_INTRINSIC_FUNCTIONAL_MAP_H_

#include <ceres_ed/registration/intrinsic/eigenfunctions.h>
#include <ceres_ed/registration/intrinsic/nearest_rows.h>

#include <algorithm>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns the rows of `matrix` with the indices `rows`, in their order.
Eigen::MatrixXd Rows(const Eigen::MatrixXd& matrix, const std::vector<int>& rows);

// Two surfaces whose points are compared, each represented by some of its vertices.
struct SpectralPair {
  const SpectralBasis* source = nullptr;
  const SpectralBasis* target = nullptr;
  std::vector<int> source_rows;
  std::vector<int> target_rows;

  // Returns the largest number of eigenfunctions that both have.
  int size() const { return std::min(source->size(), target->size()); }
};

// Returns the functional map C (size x size) of a point map between pair.source_rows and
// pair.target_rows: the least-squares solution of Phi_source C = Phi_target over all points and
// their images in both directions, with the first `size` eigenfunctions of each surface. For an
// isometry without repeated eigenvalues it is diagonal, with entries 1 and -1.
Eigen::MatrixXd FunctionalMap(const SpectralPair& pair, const PointMap& map, int size);

// Returns the point map of a functional map: the nearest of the eigenfunctions of the source times
// C and those of the target, in both directions.
PointMap PointMapOf(const SpectralPair& pair, const Eigen::MatrixXd& map);

// Refines a point map from `size` eigenfunctions to `last_size` in steps of `step` (ZoomOut, Melzi
// et al. 2019): each step makes a functional map of the point map, and a point map of that. Both
// directions take part (as in Ren et al. 2020, "MapTree"), so that neither surface is left
// uncovered. Sizes are limited to those of the bases.
PointMap ZoomOut(const SpectralPair& pair, PointMap map, int size, int last_size, int step);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_INTRINSIC_FUNCTIONAL_MAP_H_
