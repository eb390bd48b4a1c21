// The sparsity pattern of the normal equations: which of their blocks may be non-zero.
#ifndef CERES_ED_LINEAR_ALGEBRA_BLOCK_STRUCTURE_H_
#define CERES_ED_LINEAR_ALGEBRA_BLOCK_STRUCTURE_H_

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A block of kSplitBlockSize rows may be eliminated in two parts: its head, which is the first
// kSplitOffset rows, and the rest.
inline constexpr int kSplitBlockSize = 12;
inline constexpr int kSplitOffset = 9;

// Two blocks of a matrix whose common block (row, column) may be non-zero.
struct BlockPair {
  int row = 0;
  int column = 0;
  // Whether the part of the block that couples the two heads may be non-zero. It is false only
  // between two blocks of kSplitBlockSize rows.
  bool head_pair = true;

  bool operator==(const BlockPair& other) const {
    return row == other.row && column == other.column && head_pair == other.head_pair;
  }
};

// The sparsity pattern of a symmetric matrix of blocks. It stores the lower triangle, column by
// column. Every diagonal block is an entry, and is the first entry of its column.
class BlockStructure {
 public:
  // Block i has `sizes[i]` rows. `pairs` names the pairs of blocks that may be non-zero, in any
  // order, from either triangle; repetitions are allowed. The last `num_dual` blocks are dual: the
  // matrix is negative definite on them and positive definite on the others (symmetric
  // quasi-definite).
  BlockStructure(std::vector<int> sizes, const std::vector<BlockPair>& pairs, int num_dual = 0);

  int num_blocks() const { return static_cast<int>(sizes_.size()); }
  int size(int block) const { return sizes_[block]; }
  int num_dual() const { return num_dual_; }
  bool is_dual(int block) const { return block >= num_blocks() - num_dual_; }
  // Returns the first scalar row of a block; row_offset(num_blocks()) is the number of scalar rows.
  int row_offset(int block) const { return row_offsets_[block]; }
  int num_rows() const { return row_offsets_.back(); }
  // Returns the number of scalar rows of the blocks that are not dual. These rows come first.
  int num_primal_rows() const { return row_offsets_[num_blocks() - num_dual_]; }

  // Returns the first entry of a column. The blocks of column j are the entries column_begin(j) to
  // column_begin(j + 1), sorted by row.
  int column_begin(int column) const { return column_begins_[column]; }
  int num_entries() const { return static_cast<int>(entry_rows_.size()); }
  int entry_row(int entry) const { return entry_rows_[entry]; }
  // Returns BlockPair::head_pair of an entry; it is true for a diagonal block.
  bool head_pair(int entry) const { return head_pairs_[entry] != 0; }
  // Returns where the values of an entry start in the array of all values. They are column-major,
  // of size(row) x size(column).
  std::size_t value_offset(int entry) const { return value_offsets_[entry]; }
  std::size_t num_values() const { return value_offsets_.back(); }

  // Returns the entry of the block (row, column), where row >= column, or -1 if the block is not in
  // the pattern.
  int FindEntry(int row, int column) const;

  // Returns all entries below the diagonal, column by column.
  std::vector<BlockPair> Pairs() const;

  // Returns the scalar diagonal of a matrix of this pattern. The diagonal of the primal rows is the
  // one that they have after the dual blocks have been eliminated, under the assumption that the
  // diagonal blocks of the dual rows are -I.
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
