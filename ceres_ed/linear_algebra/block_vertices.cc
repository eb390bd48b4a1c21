#include "ceres_ed/linear_algebra/block_vertices.h"

namespace ceres_ed {
namespace {

// Returns one entry per block, which is non-zero if the block can be split, that is, if it has
// kSplitBlockSize rows and its head shares no value with another head.
std::vector<char> LoneHeads(const BlockStructure& structure, int num_trailing) {
  std::vector<char> lone(structure.num_blocks(), 0);
  for (int j = 0; j < structure.num_blocks() - num_trailing; ++j) {
    lone[j] = structure.size(j) == kSplitBlockSize && !structure.is_dual(j) ? 1 : 0;
  }
  for (int j = 0; j < structure.num_blocks(); ++j) {
    for (int e = structure.column_begin(j) + 1; e < structure.column_begin(j + 1); ++e) {
      const int i = structure.entry_row(e);
      if (!structure.head_pair(e) || structure.is_dual(i) || structure.is_dual(j)) continue;
      lone[i] = 0;
      lone[j] = 0;
    }
  }
  return lone;
}

}  // namespace

BlockVertices::BlockVertices(const BlockStructure& structure, int num_trailing) {
  const std::vector<char> lone = LoneHeads(structure, num_trailing);
  for (int j = 0; j < structure.num_blocks(); ++j) {
    first_vertex_.push_back(size());
    if (lone[j] != 0) {
      vertices_.push_back({j, 0, kSplitOffset});
      vertices_.push_back({j, kSplitOffset, kSplitBlockSize - kSplitOffset});
      is_head_.push_back(1);
    } else {
      vertices_.push_back({j, 0, structure.size(j), structure.is_dual(j)});
    }
    is_head_.push_back(0);
  }
  first_vertex_.push_back(size());
}

std::vector<BlockPiece> BlockVertices::Pieces(const BlockStructure& structure) const {
  std::vector<BlockPiece> pieces;
  pieces.reserve(structure.num_entries());
  for (int j = 0; j < structure.num_blocks(); ++j) {
    for (int e = structure.column_begin(j); e < structure.column_begin(j + 1); ++e) {
      const int i = structure.entry_row(e);
      const int stride = structure.size(i);
      for (int column = first_vertex_[j]; column < first_vertex_[j + 1]; ++column) {
        for (int row = i == j ? column : first_vertex_[i]; row < first_vertex_[i + 1]; ++row) {
          if (i != j && is_head_[row] != 0 && is_head_[column] != 0) continue;
          pieces.push_back({row,
                            column,
                            structure.value_offset(e) +
                                static_cast<std::size_t>(vertices_[column].offset) * stride +
                                vertices_[row].offset,
                            stride});
        }
      }
    }
  }
  return pieces;
}

RowGraph BlockVertices::Graph(const std::vector<BlockPiece>& pieces) const {
  RowGraph graph;
  for (const BlockVertex& vertex : vertices_) {
    graph.sizes.push_back(vertex.size);
    graph.is_dual.push_back(vertex.is_dual ? 1 : 0);
  }
  graph.begins.assign(size() + 1, 0);
  for (const BlockPiece& piece : pieces) {
    if (piece.row == piece.column) continue;
    ++graph.begins[piece.row + 1];
    ++graph.begins[piece.column + 1];
  }
  for (int v = 0; v < size(); ++v) graph.begins[v + 1] += graph.begins[v];
  std::vector<int> next(graph.begins.begin(), graph.begins.end() - 1);
  graph.neighbors.resize(graph.begins.back());
  for (const BlockPiece& piece : pieces) {
    if (piece.row == piece.column) continue;
    graph.neighbors[next[piece.row]++] = piece.column;
    graph.neighbors[next[piece.column]++] = piece.row;
  }
  return graph;
}

}  // namespace ceres_ed
