// The symbolic part of a multifrontal Cholesky factorisation.
#ifndef CERES_ED_LINEAR_ALGEBRA_FRONT_TREE_H_
#define CERES_ED_LINEAR_ALGEBRA_FRONT_TREE_H_

#include <ceres_ed/linear_algebra/elimination_order.h>

#include <vector>

namespace ceres_ed {

// A dense frontal matrix: the vertices that it eliminates (`columns`), and the vertices that their
// elimination changes (`below`).
struct Front {
  // The dual vertices come first.
  std::vector<int> columns;
  // In the order of elimination.
  std::vector<int> below;
  // The number of scalar rows of the dual columns, of all columns, and of the columns together with
  // the rows below them.
  int dual_width = 0;
  int width = 0;
  int height = 0;
  // The index of the later front that eliminates the first vertex of `below`, or -1 if there is
  // none.
  int parent = -1;
};

// Returns the fronts that eliminate `graph` in `order`, or in an equivalent order. Children come
// before their parents, and each subtree is contiguous. Fronts are merged where one front takes
// less time than two. The last `num_trailing` vertices of `order` share one front and keep their
// order.
std::vector<Front> BuildFronts(const RowGraph& graph,
                               const std::vector<int>& order,
                               int num_trailing);

// Returns the number of multiplications (each with an addition) that the elimination of a front
// takes, w^3 / 6 + w^2 u / 2 + w u^2 / 2 with w = width and u = height - width.
double FrontOperations(int width, int height);

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_FRONT_TREE_H_
