// The vertices into which a block matrix is divided for elimination.
#ifndef CERES_ED_LINEAR_ALGEBRA_BLOCK_VERTICES_H_
#define CERES_ED_LINEAR_ALGEBRA_BLOCK_VERTICES_H_

#include <ceres_ed/linear_algebra/block_structure.h>
#include <ceres_ed/linear_algebra/front_tree.h>

#include <cstddef>
#include <vector>

namespace ceres_ed {

// A vertex of the elimination graph: a whole block, or one of the two parts (head and rest) of a
// block whose head shares no value with another head.
struct BlockVertex {
  int block = 0;
  // The first scalar row within the block, and the number of rows.
  int offset = 0;
  int size = 0;
  bool is_dual = false;
};

// The part of the matrix that two vertices share: the rows of vertex `row` and the columns of
// vertex `column`. Its values start at `value` and are column-major with the given `stride`.
struct BlockPiece {
  int row = 0;
  int column = 0;
  std::size_t value = 0;
  int stride = 0;
};

// The vertices of a block structure, in ascending order of their rows. Each of the last
// `num_trailing` blocks is one vertex.
class BlockVertices {
 public:
  BlockVertices(const BlockStructure& structure, int num_trailing);

  int size() const { return static_cast<int>(vertices_.size()); }
  const BlockVertex& operator[](int vertex) const { return vertices_[vertex]; }
  // Returns one entry per vertex, which is non-zero for a head. No two heads are neighbours.
  const std::vector<char>& is_head() const { return is_head_; }
  // Returns all parts of the matrix that may be non-zero, each once. They cover the lower triangle
  // of blocks.
  std::vector<BlockPiece> Pieces(const BlockStructure& structure) const;
  // Returns the graph in which two vertices are neighbours if they share a piece.
  RowGraph Graph(const std::vector<BlockPiece>& pieces) const;

 private:
  std::vector<BlockVertex> vertices_;
  std::vector<char> is_head_;
  // The first vertex of each block; one more entry at the end is the number of vertices.
  std::vector<int> first_vertex_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_BLOCK_VERTICES_H_
