// The memory layout of a multifrontal factorisation, and the order in which its fronts are
// computed.
#ifndef CERES_ED_LINEAR_ALGEBRA_FRONT_LAYOUT_H_
#define CERES_ED_LINEAR_ALGEBRA_FRONT_LAYOUT_H_

#include <ceres_ed/linear_algebra/block_vertices.h>
#include <ceres_ed/linear_algebra/front_tree.h>

#include <cstddef>
#include <vector>

namespace ceres_ed {

// A run of rows that are adjacent in a source and in a destination: `length` rows from row `from`
// on go to row `to` on.
struct RowRun {
  int from = 0;
  int to = 0;
  int length = 0;
};

// The layout of one front. Its panel [L11; L21] is kept; its update -L21 L21^T, of which the lower
// triangle is stored in strips (front_kernels.h), exists until the parent has added it.
struct FrontLayout {
  // The number of columns: the `dual_width` dual columns come first, then the others. The panel has
  // as many rows of its own; those that are not dual start at `own_row`.
  int dual_width = 0;
  int width = 0;
  int own_row = 0;
  // The number of rows of the update, without and with padding. L21 starts at row `below_row` of
  // the panel.
  int update_rows = 0;
  int padded_update_rows = 0;
  int below_row = 0;
  int panel_stride = 0;
  // Where the panel starts, in the array of all panels.
  std::size_t panel = 0;
  // Where the update starts, if several threads work: among the updates that outlive their task if
  // `is_kept`, else on the stack of the thread that computes it.
  std::size_t update = 0;
  bool is_kept = false;
  // Where it starts if one thread computes all fronts in their order.
  std::size_t serial_update = 0;
  // The position of the first column in the order of elimination; the other columns follow it.
  int first_position = 0;
  // Maps the rows of the update to positions in the order of elimination.
  std::vector<RowRun> below;
  // Map the rows of the update to the rows of the parent: `to_columns` to those rows of the
  // parent's panel that belong to its own columns, `to_update` to rows of the parent's update.
  std::vector<RowRun> to_columns;
  std::vector<RowRun> to_update;
  std::vector<int> children;
  // The pieces [first_piece, last_piece) of FactorLayout::pieces belong to this front.
  int first_piece = 0;
  int last_piece = 0;

  int panel_rows() const { return below_row + padded_update_rows; }
  // Converts a column to the row of the panel that contains its diagonal value, and ColumnOfRow()
  // does the reverse.
  int RowOfColumn(int column) const {
    return column < dual_width ? column : own_row + column - dual_width;
  }
  int ColumnOfRow(int row) const { return row < own_row ? row : row - own_row + dual_width; }
};

// A part of the matrix and its place in a panel.
struct PanelPiece {
  std::size_t value = 0;
  int stride = 0;
  int rows = 0;
  int columns = 0;
  int panel_row = 0;
  int panel_column = 0;
  // Whether the panel takes the transpose of the values. `rows` and `columns` are those of the
  // panel.
  bool transposed = false;
};

// The fronts [first, last), which need no result of other tasks, so that different tasks can be
// computed at the same time.
struct FrontTask {
  int first = 0;
  int last = 0;
};

// The layout of a whole factor.
struct FactorLayout {
  std::vector<FrontLayout> fronts;
  std::vector<PanelPiece> pieces;
  // The tasks, sorted by their first front. Fronts that belong to no task are computed after all
  // tasks.
  std::vector<FrontTask> tasks;
  // The position of the first row of each vertex in the order of elimination.
  std::vector<int> positions;
  int num_rows = 0;
  // The number of doubles of all panels, of the updates that outlive their task, and of the largest
  // stack of the other updates.
  std::size_t panel_size = 0;
  std::size_t kept_size = 0;
  std::size_t stack_size = 0;
  // The number of doubles of all updates if one thread computes all fronts. It is less than the sum
  // of those, since no update waits for the end of all tasks.
  std::size_t serial_size = 0;
  int max_panel_rows = 0;
  double operations = 0.0;
};

// Returns the layout of the factor whose `fronts` eliminate `vertices`, for a matrix with these
// `pieces`.
FactorLayout LayOutFactor(const BlockVertices& vertices,
                          const std::vector<BlockPiece>& pieces,
                          const std::vector<Front>& fronts);

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_FRONT_LAYOUT_H_
