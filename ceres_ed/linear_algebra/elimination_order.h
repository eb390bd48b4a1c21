// In which order the vertices of a sparse symmetric matrix are eliminated.
#ifndef CERES_ED_LINEAR_ALGEBRA_ELIMINATION_ORDER_H_
#define CERES_ED_LINEAR_ALGEBRA_ELIMINATION_ORDER_H_

#include <vector>

namespace ceres_ed {

// A symmetric graph of vertices that each stand for some scalar rows.
struct RowGraph {
  // Scalar rows of each vertex, and whether they are dual (see BlockStructure).
  std::vector<int> sizes;
  std::vector<char> is_dual;
  // Neighbours of vertex v: neighbors[begins[v]] to neighbors[begins[v + 1]], in any order, without
  // itself and without repetition.
  std::vector<int> begins;
  std::vector<int> neighbors;

  int num_vertices() const { return static_cast<int>(sizes.size()); }
};

enum class OrderingMethod {
  // Quick, and good on small or slender graphs.
  kMinimumDegree,
  // Slower by an order of magnitude, and better on large sheets. Needs CHOLMOD, see
  // HasNestedDissection().
  kNestedDissection,
};

bool HasNestedDissection();

// An order with little fill: vertices of `first` come first (no two of them may be neighbours), the
// last `num_trailing` vertices last and as they stand. `first` has one entry a vertex.
// kMinimumDegree takes the place of kNestedDissection where that isn't there. Of each connected
// part with dual vertices, some of the others come behind these: without the duals nothing holds a
// rigid motion, so something has to stay until they have had their say.
std::vector<int> FillReducingOrder(const RowGraph& graph,
                                   const std::vector<char>& first,
                                   int num_trailing,
                                   OrderingMethod method);

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_ELIMINATION_ORDER_H_
