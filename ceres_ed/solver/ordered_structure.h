// A block structure in the order in which it is factorised.
#ifndef CERES_ED_SOLVER_ORDERED_STRUCTURE_H_
#define CERES_ED_SOLVER_ORDERED_STRUCTURE_H_

#include <ceres_ed/solver/block_structure.h>

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The same blocks in another order, and where the values of each entry go in the compressed lower
// triangle of the scalar matrix there. `original` must outlive it.
class OrderedStructure {
 public:
  // `order[k]` is the block that comes k-th.
  OrderedStructure(const BlockStructure& original, const std::vector<int>& order);

  const BlockStructure& ordered() const { return ordered_; }

  // Copies block values (layout of the original) into the scalar lower triangle `out`, column by
  // column, and adds `diagonal` (order of the original).
  void FillValues(const double* values, const Eigen::VectorXd& diagonal, double* out) const;

  // Move rows between the two orders.
  void ToOrdered(const Eigen::VectorXd& rows, double* ordered_rows) const;
  void FromOrdered(const double* ordered_rows, Eigen::VectorXd* rows) const;

 private:
  // Scalar column c of a block column is c rows shorter than its first: only the lower triangle is
  // stored.
  std::ptrdiff_t ColumnShift(int ordered_column, int c) const {
    return c * column_height_[ordered_column] - c * (c + 1) / 2;
  }
  void CopyDiagonal(int block,
                    int ordered_entry,
                    const double* values,
                    const Eigen::VectorXd& diagonal,
                    double* out) const;
  void CopyBlock(int row, int column, int entry, const double* values, double* out) const;

  const BlockStructure& original_;
  // Of each original block.
  std::vector<int> position_;
  BlockStructure ordered_;
  // Of each ordered entry: where it starts in the first scalar column of its block column.
  std::vector<std::ptrdiff_t> entry_start_;
  // Of each ordered block column: the height of its first scalar column.
  std::vector<std::ptrdiff_t> column_height_;
  // Of each original entry: its ordered entry, and whether it lies transposed there.
  std::vector<int> entry_of_;
  std::vector<char> transposed_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_ORDERED_STRUCTURE_H_
