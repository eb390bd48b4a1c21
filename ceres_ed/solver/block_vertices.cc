#include "ceres_ed/solver/block_vertices.h"

#include <cost_functions/node_parameters.h>

namespace ceres_ed {
namespace {

// One entry a block: whether it is a node that shares no affine part with another block.
std::vector<char> LoneAffineParts(const BlockStructure& structure, int num_trailing) {
  std::vector<char> lone(structure.num_blocks(), 0);
  for (int j = 0; j < structure.num_blocks() - num_trailing; ++j) {
    lone[j] = structure.size(j) == kNodeSize ? 1 : 0;
  }
  for (int j = 0; j < structure.num_blocks(); ++j) {
    for (int e = structure.column_begin(j) + 1; e < structure.column_begin(j + 1); ++e) {
      if (!structure.affine_pair(e)) continue;
      lone[j] = 0;
      lone[structure.entry_row(e)] = 0;
    }
  }
  return lone;
}

}  // namespace

BlockVertices::BlockVertices(const BlockStructure& structure, int num_trailing) {
  const std::vector<char> lone = LoneAffineParts(structure, num_trailing);
  for (int j = 0; j < structure.num_blocks(); ++j) {
    first_vertex_.push_back(size());
    if (lone[j] != 0) {
      vertices_.push_back({j, 0, kNodeTranslationOffset});
      vertices_.push_back({j, kNodeTranslationOffset, kNodeSize - kNodeTranslationOffset});
      is_affine_.push_back(1);
    } else {
      vertices_.push_back({j, 0, structure.size(j)});
    }
    is_affine_.push_back(0);
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
          if (i != j && is_affine_[row] != 0 && is_affine_[column] != 0) continue;
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
  for (const BlockVertex& vertex : vertices_) graph.sizes.push_back(vertex.size);
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
