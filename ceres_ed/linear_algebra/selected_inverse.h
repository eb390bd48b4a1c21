// Entries of the inverse of a factorised block matrix.
#ifndef CERES_ED_LINEAR_ALGEBRA_SELECTED_INVERSE_H_
#define CERES_ED_LINEAR_ALGEBRA_SELECTED_INVERSE_H_

#include <ceres_ed/linear_algebra/block_structure.h>
#include <ceres_ed/linear_algebra/block_vertices.h>
#include <ceres_ed/linear_algebra/multifrontal_factor.h>

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Z = (L L^T)^-1 where L may be non-zero (Takahashi et al. 1973), front by front from the roots to
// the leaves. With a front's own rows P, the rows U below them and Y = L_UP L_PP^-1:
//   Z_UP = -Z_UU Y,  Z_PP = (L_PP L_PP^T)^-1 + Y^T Z_UU Y
// where Z_UU is part of what the front's parent has. That takes about twice the operations of the
// factorisation, where all of Z would take the square of the number of rows in memory alone.
class SelectedInverse {
 public:
  // Of the last successful factor, which has no dual rows. All three must outlive this; the factor
  // may have changed by then.
  SelectedInverse(const BlockStructure& structure,
                  const BlockVertices& vertices,
                  const MultifrontalFactor& factor);

  // Writes block (row, column) of Z, size(row) x size(column); from several threads at once, too.
  // False when it isn't all there, that is, when the two share no entry of the factor; what is
  // missing is zero then. Diagonal blocks are there, and blocks of pairs of the structure but for
  // what couples two heads that the structure says don't share a residual.
  bool Block(int row, int column, Eigen::MatrixXd* block) const;

  // this += factor * other, the inverse of another matrix of the same structure.
  void AddScaled(double factor, const SelectedInverse& other);

 private:
  // Row of a later vertex among those of a front; -1 where it isn't there.
  int FindRow(int front, int vertex) const;
  Eigen::Map<const Eigen::MatrixXd> Panel(int front) const;

  const BlockStructure& structure_;
  const BlockVertices& vertices_;
  const FactorLayout& layout_;
  // First vertex of each block; that of the last one ends the list.
  std::vector<int> first_vertex_;
  // The front that eliminates each vertex.
  std::vector<int> front_of_vertex_;
  // Where the values [Z_PP; Z_UP] of each front start, column-major.
  std::vector<std::size_t> begins_;
  std::vector<double> values_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_SELECTED_INVERSE_H_
