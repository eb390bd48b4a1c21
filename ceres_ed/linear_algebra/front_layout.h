// Where everything of a multifrontal factorisation lies in memory, and in which order it is done.
#ifndef CERES_ED_LINEAR_ALGEBRA_FRONT_LAYOUT_H_
#define CERES_ED_LINEAR_ALGEBRA_FRONT_LAYOUT_H_

#include <ceres_ed/linear_algebra/block_vertices.h>
#include <ceres_ed/linear_algebra/front_tree.h>

#include <cstddef>
#include <vector>

namespace ceres_ed {

// Rows next to each other here and there.
struct RowRun {
  int from = 0;
  int to = 0;
  int length = 0;
};

// A front's panel [L11; L21] is kept; its update -L21 L21^T lives until the parent has taken it.
struct FrontLayout {
  // Columns: `dual_width` dual ones, then the others. Rows of the panel: as many, but the others
  // start at `own_row`.
  int dual_width = 0;
  int width = 0;
  int own_row = 0;
  // Rows of the update, as they are and as they are stored. L21 starts at row `below_row` of the
  // panel.
  int update_rows = 0;
  int padded_update_rows = 0;
  int below_row = 0;
  int panel_stride = 0;
  int update_stride = 0;
  std::size_t panel = 0;
  // Among those that are kept, or on the stack of the thread at work.
  std::size_t update = 0;
  bool is_kept = false;
  // Position of its first column in the order of elimination; the others follow.
  int first_position = 0;
  // Rows of the update: from there to positions in the order of elimination.
  std::vector<RowRun> below;
  // Rows of the update: from there to those rows of the parent's panel that are its columns, then
  // to rows of the parent's update.
  std::vector<RowRun> to_columns;
  std::vector<RowRun> to_update;
  std::vector<int> children;
  int first_piece = 0;
  int last_piece = 0;

  int panel_rows() const { return below_row + padded_update_rows; }
  // The row of the panel in which a column has its diagonal, and the other way round.
  int RowOfColumn(int column) const {
    return column < dual_width ? column : own_row + column - dual_width;
  }
  int ColumnOfRow(int row) const { return row < own_row ? row : row - own_row + dual_width; }
};

// Part of the matrix and its place in a panel.
struct PanelPiece {
  std::size_t value = 0;
  int stride = 0;
  int rows = 0;
  int columns = 0;
  int panel_row = 0;
  int panel_column = 0;
  // Stored as its transpose: `rows` and `columns` are those of the panel.
  bool transposed = false;
};

// Fronts [first, last) that need nothing of others: they can be done beside those of other tasks.
struct FrontTask {
  int first = 0;
  int last = 0;
};

struct FactorLayout {
  std::vector<FrontLayout> fronts;
  std::vector<PanelPiece> pieces;
  // By their first front. What is in none of them comes after all.
  std::vector<FrontTask> tasks;
  // Position of each vertex's first row in the order of elimination.
  std::vector<int> positions;
  int num_rows = 0;
  // Doubles of all panels, of the updates that outlive their task, and of the largest stack of the
  // others.
  std::size_t panel_size = 0;
  std::size_t kept_size = 0;
  std::size_t stack_size = 0;
  int max_panel_rows = 0;
  double operations = 0.0;
};

FactorLayout LayOutFactor(const BlockVertices& vertices,
                          const std::vector<BlockPiece>& pieces,
                          const std::vector<Front>& fronts);

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_FRONT_LAYOUT_H_
