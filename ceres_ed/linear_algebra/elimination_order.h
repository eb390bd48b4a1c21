// The order in which the vertices of a sparse symmetric matrix are eliminated.
#ifndef CERES_ED_LINEAR_ALGEBRA_ELIMINATION_ORDER_H_
#define CERES_ED_LINEAR_ALGEBRA_ELIMINATION_ORDER_H_

#include <vector>

namespace ceres_ed {

// A symmetric graph in which each vertex stands for one or more scalar rows.
struct RowGraph {
  // The number of scalar rows of each vertex, and whether they are dual (see BlockStructure).
  std::vector<int> sizes;
  std::vector<char> is_dual;
  // The neighbours of vertex v are neighbors[begins[v]] to neighbors[begins[v + 1]], in any order.
  // They do not contain v itself and have no repetitions.
  std::vector<int> begins;
  std::vector<int> neighbors;

  int num_vertices() const { return static_cast<int>(sizes.size()); }
};

// The method that computes the order.
enum class OrderingMethod {
  // Fast, and good on small or slender graphs.
  kMinimumDegree,
  // Slower by an order of magnitude, and better on large surfaces. It needs CHOLMOD, see
  // HasNestedDissection().
  kNestedDissection,
};

// Returns whether kNestedDissection is available, that is, whether the library was built with
// CHOLMOD.
bool HasNestedDissection();

// Returns an order of elimination with little fill.
//
// Vertices for which `first` is non-zero come first (no two of them may be neighbours; `first` has
// one entry per vertex). The last `num_trailing` vertices come last, in their given order. If
// nested dissection is not available, kMinimumDegree is used in its place. In each connected part
// that contains dual vertices, a few of the primal vertices are moved to the end, behind the dual
// ones: without the dual rows a rigid motion of the part is not determined, so some primal vertices
// must remain until the dual rows have been eliminated.
std::vector<int> FillReducingOrder(const RowGraph& graph,
                                   const std::vector<char>& first,
                                   int num_trailing,
                                   OrderingMethod method);

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_ELIMINATION_ORDER_H_
