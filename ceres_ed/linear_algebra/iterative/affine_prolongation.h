// How the nodes of a graph follow those of a coarser one.
#ifndef CERES_ED_LINEAR_ALGEBRA_ITERATIVE_AFFINE_PROLONGATION_H_
#define CERES_ED_LINEAR_ALGEBRA_ITERATIVE_AFFINE_PROLONGATION_H_

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A linear map Z from the parameters of coarse nodes to those of fine ones. A coarse node J at c_J
// with the change (A_J, t_J) changes the fine node i at g_i by
//   A_i = sum_J w_iJ A_J,  t_i = sum_J w_iJ (A_J (g_i - c_J) + t_J),
// which is what the warp of the coarse graph (Eq. 1) makes of the node and its surroundings. If the
// weights of a node sum to 1, an affine motion of all coarse nodes is the same motion of the fine
// ones, which costs no regularisation (Eq. 6).
struct AffineProlongation {
  struct Part {
    int coarse = 0;
    double weight = 0.0;
    // g_i - c_J.
    Eigen::Vector3d lever = Eigen::Vector3d::Zero();
  };

  int num_coarse = 0;
  // The parts of fine node i are those from begins[i] to begins[i + 1].
  std::vector<int> begins = {0};
  std::vector<Part> parts;

  int num_fine() const { return static_cast<int>(begins.size()) - 1; }
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_ITERATIVE_AFFINE_PROLONGATION_H_
