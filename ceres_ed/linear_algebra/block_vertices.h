// The vertices that a block matrix is eliminated by.
#ifndef CERES_ED_LINEAR_ALGEBRA_BLOCK_VERTICES_H_
#define CERES_ED_LINEAR_ALGEBRA_BLOCK_VERTICES_H_

#include <ceres_ed/linear_algebra/block_structure.h>
#include <ceres_ed/linear_algebra/front_tree.h>

#include <cstddef>
#include <vector>

namespace ceres_ed {

// A block, or one of the two parts of a block whose head shares no value with another head: the
// head and the rest.
struct BlockVertex {
  int block = 0;
  // First scalar row within the block, and number of rows.
  int offset = 0;
  int size = 0;
  bool is_dual = false;
};

// Part of the matrix that two vertices share: rows of `row`, columns of `column`, and where its
// values start, column-major with `stride`.
struct BlockPiece {
  int row = 0;
  int column = 0;
  std::size_t value = 0;
  int stride = 0;
};

// The vertices of a structure, ascending by row. The last `num_trailing` blocks are whole.
class BlockVertices {
 public:
  BlockVertices(const BlockStructure& structure, int num_trailing);

  int size() const { return static_cast<int>(vertices_.size()); }
  const BlockVertex& operator[](int vertex) const { return vertices_[vertex]; }
  // Nonzero for heads: no two of them are neighbours.
  const std::vector<char>& is_head() const { return is_head_; }
  // All parts of the matrix that may be non-zero, each once: lower triangle by blocks.
  std::vector<BlockPiece> Pieces(const BlockStructure& structure) const;
  // Who shares a piece with whom.
  RowGraph Graph(const std::vector<BlockPiece>& pieces) const;

 private:
  std::vector<BlockVertex> vertices_;
  std::vector<char> is_head_;
  // Of each block; that of the last one ends the list.
  std::vector<int> first_vertex_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_BLOCK_VERTICES_H_
