// The symbolic part of a multifrontal Cholesky factorisation.
#ifndef CERES_ED_LINEAR_ALGEBRA_FRONT_TREE_H_
#define CERES_ED_LINEAR_ALGEBRA_FRONT_TREE_H_

#include <ceres_ed/linear_algebra/elimination_order.h>

#include <vector>

namespace ceres_ed {

// A dense front: the vertices that it eliminates, and those that they leave an update on.
struct Front {
  // The dual ones first.
  std::vector<int> columns;
  // In the order of elimination.
  std::vector<int> below;
  // Scalar rows of the dual columns, of all columns, and of columns and rows below.
  int dual_width = 0;
  int width = 0;
  int height = 0;
  // A later front that eliminates the first of `below`; -1 where there is none.
  int parent = -1;
};

// The fronts that eliminate `graph` in `order`, up to an equivalent order: children come ahead of
// their parents, each subtree without a gap. Vertices share a front where that takes less time than
// two. The last `num_trailing` vertices of `order` share one front, as they stand there.
std::vector<Front> BuildFronts(const RowGraph& graph,
                               const std::vector<int>& order,
                               int num_trailing);

// Multiplications and additions that a front takes.
double FrontOperations(int width, int height);

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_FRONT_TREE_H_
