// The coarse graph of the two-level preconditioner.
#ifndef CERES_ED_SOLVER_STEPS_COARSE_SPACE_H_
#define CERES_ED_SOLVER_STEPS_COARSE_SPACE_H_

#include <ceres_ed/linear_algebra/iterative/affine_prolongation.h>
#include <ceres_ed/linear_algebra/iterative/primal_matrix.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Chooses coarse nodes among the first positions.size() blocks of `matrix`, which are nodes at
// these places, and binds all nodes to them. Coarse nodes are more than kCoarseRings neighbours
// apart, and every node has one within as many. A node follows those of the coarse nodes within
// twice that number that are nearest to it, by the weights of the warp (Sumner et al. 2007).
// Neighbours are nodes that share an entry of the matrix, so that two sheets that only touch do not
// mix. Only the pattern of the matrix is used.
inline constexpr int kCoarseRings = 6;
AffineProlongation MakeCoarseSpace(const PrimalMatrix& matrix,
                                   const std::vector<Eigen::Vector3d>& positions);

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_STEPS_COARSE_SPACE_H_
