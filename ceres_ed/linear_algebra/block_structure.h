// Which blocks of the normal equations are there.
#ifndef CERES_ED_LINEAR_ALGEBRA_BLOCK_STRUCTURE_H_
#define CERES_ED_LINEAR_ALGEBRA_BLOCK_STRUCTURE_H_

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Blocks of kSplitBlockSize rows may be eliminated in two parts: the head, which is the rows in
// front of kSplitOffset, and the rest.
inline constexpr int kSplitBlockSize = 12;
inline constexpr int kSplitOffset = 9;

// Two blocks whose product may be non-zero.
struct BlockPair {
  int row = 0;
  int column = 0;
  // Whether the part that both heads share may be non-zero. Only false between two blocks of
  // kSplitBlockSize rows.
  bool head_pair = true;

  bool operator==(const BlockPair& other) const {
    return row == other.row && column == other.column && head_pair == other.head_pair;
  }
};

// The sparsity of a symmetric matrix of blocks, lower triangle, column by column. The diagonal
// blocks are always there and come first in their columns.
class BlockStructure {
 public:
  // `sizes[i]` rows of block i. `pairs` of blocks that may be non-zero: any order, any triangle,
  // repeated or not. The last `num_dual` blocks are dual: the matrix is negative definite on them
  // and positive definite on the others (symmetric quasi-definite).
  BlockStructure(std::vector<int> sizes, const std::vector<BlockPair>& pairs, int num_dual = 0);

  int num_blocks() const { return static_cast<int>(sizes_.size()); }
  int size(int block) const { return sizes_[block]; }
  int num_dual() const { return num_dual_; }
  bool is_dual(int block) const { return block >= num_blocks() - num_dual_; }
  // First scalar row of a block; row_offset(num_blocks()) is the number of scalar rows.
  int row_offset(int block) const { return row_offsets_[block]; }
  int num_rows() const { return row_offsets_.back(); }
  // Those of the blocks that aren't dual, which come first.
  int num_primal_rows() const { return row_offsets_[num_blocks() - num_dual_]; }

  // Blocks of column j are entries column_begin(j) to column_begin(j + 1), by row.
  int column_begin(int column) const { return column_begins_[column]; }
  int num_entries() const { return static_cast<int>(entry_rows_.size()); }
  int entry_row(int entry) const { return entry_rows_[entry]; }
  // BlockPair::head_pair; true of diagonal blocks.
  bool head_pair(int entry) const { return head_pairs_[entry] != 0; }
  // Where the values of an entry start; they are column-major, size(row) x size(column).
  std::size_t value_offset(int entry) const { return value_offsets_[entry]; }
  std::size_t num_values() const { return value_offsets_.back(); }

  // The entry of (row, column), row >= column; -1 when it isn't there.
  int FindEntry(int row, int column) const;

  // All entries below the diagonal, column by column.
  std::vector<BlockPair> Pairs() const;

  // The scalar diagonal of a matrix of this structure, and, of primal rows, what it is once the
  // dual ones have been eliminated, whose own blocks are to be -I.
  Eigen::VectorXd Diagonal(const std::vector<double>& values) const;

 private:
  std::vector<int> sizes_;
  int num_dual_;
  std::vector<int> row_offsets_;
  std::vector<int> column_begins_;
  std::vector<int> entry_rows_;
  std::vector<char> head_pairs_;
  std::vector<std::size_t> value_offsets_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_BLOCK_STRUCTURE_H_
