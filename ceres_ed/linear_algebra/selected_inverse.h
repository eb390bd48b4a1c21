// Selected entries of the inverse of a factorised block matrix.
#ifndef CERES_ED_LINEAR_ALGEBRA_SELECTED_INVERSE_H_
#define CERES_ED_LINEAR_ALGEBRA_SELECTED_INVERSE_H_

#include <ceres_ed/linear_algebra/block_structure.h>
#include <ceres_ed/linear_algebra/block_vertices.h>
#include <ceres_ed/linear_algebra/multifrontal_factor.h>

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The entries of Z = (L L^T)^-1 at all places where L may be non-zero (Takahashi et al. 1973). They
// are computed front by front from the roots to the leaves. With a front's own rows P, the rows U
// below them and Y = L_UP L_PP^-1,
//   Z_UP = -Z_UU Y,  Z_PP = (L_PP L_PP^T)^-1 + Y^T Z_UU Y,
// where Z_UU is part of the front of the parent. This takes about twice the operations of the
// factorisation, whereas the memory for all of Z would grow with the square of the number of rows.
class SelectedInverse {
 public:
  // Inverts the last successful factor, which must have no dual rows. All three arguments must
  // outlive this object; the values of the factor may change later.
  SelectedInverse(const BlockStructure& structure,
                  const BlockVertices& vertices,
                  const MultifrontalFactor& factor);

  // Writes the block (row, column) of Z, of size(row) x size(column). Returns false if the block is
  // incomplete, that is, if the two share no entry of the factor; missing values are zero. Diagonal
  // blocks are complete. Blocks of pairs in the structure are complete except for the part that
  // couples two heads which, by the structure, share no residual. May be called from several
  // threads at once.
  bool Block(int row, int column, Eigen::MatrixXd* block) const;

  // Computes this += factor * other, where `other` is the inverse of another matrix of the same
  // structure.
  void AddScaled(double factor, const SelectedInverse& other);

 private:
  // Returns the row of a later vertex among the rows of a front, or -1 if the front does not
  // contain it.
  int FindRow(int front, int vertex) const;
  Eigen::Map<const Eigen::MatrixXd> Panel(int front) const;

  const BlockStructure& structure_;
  const BlockVertices& vertices_;
  const FactorLayout& layout_;
  // The first vertex of each block; one more entry at the end is the number of vertices.
  std::vector<int> first_vertex_;
  // The front that eliminates each vertex.
  std::vector<int> front_of_vertex_;
  // Where the values [Z_PP; Z_UP] of each front start. They are column-major.
  std::vector<std::size_t> begins_;
  std::vector<double> values_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_SELECTED_INVERSE_H_
