#include "ceres_ed/linear_algebra/multifrontal_factor.h"

#include <ceres_ed/linear_algebra/front_kernels.h>
#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <atomic>
#include <utility>

namespace ceres_ed {
namespace {

// Updates with fewer multiplications than this are not worth a second thread.
constexpr double kParallelUpdate = 4e6;

// Adds the rows [begin, ...) of a column of a child's update to a column of the parent.
void AddRuns(const std::vector<RowRun>& runs, int begin, const double* from, double* to) {
  for (const RowRun& run : runs) {
    const int skipped = std::max(0, begin - run.from);
    for (int i = skipped; i < run.length; ++i) to[run.to + i] += from[run.from + i];
  }
}

}  // namespace

MultifrontalFactor::MultifrontalFactor(FactorLayout layout, FactorMemory* memory)
    : layout_(std::move(layout)),
      memory_(memory),
      update_places_(layout_.fronts.size()),
      panel_rows_(layout_.max_panel_rows) {
  memory_->panels.Require(layout_.panel_size);
}

// Copies the values of the matrix into the panel of a front and adds `diagonal`.
void MultifrontalFactor::TakePieces(const FrontLayout& front,
                                    const double* values,
                                    const Eigen::VectorXd& diagonal) {
  double* panel = Panel(front);
  for (int p = front.first_piece; p < front.last_piece; ++p) {
    const PanelPiece& piece = layout_.pieces[p];
    const double* from = values + piece.value;
    double* to = panel + static_cast<std::ptrdiff_t>(piece.panel_column) * front.panel_stride +
                 piece.panel_row;
    for (int c = 0; c < piece.columns; ++c, to += front.panel_stride) {
      if (piece.transposed) {
        for (int r = 0; r < piece.rows; ++r) to[r] = from[r * piece.stride + c];
      } else {
        for (int r = 0; r < piece.rows; ++r) to[r] = from[c * piece.stride + r];
      }
    }
  }
  for (int c = 0; c < front.width; ++c) {
    panel[static_cast<std::ptrdiff_t>(c) * front.panel_stride + front.RowOfColumn(c)] +=
        diagonal[front.first_position + c];
  }
}

// Adds the part of a child's update that belongs to the parent's own columns.
void MultifrontalFactor::TakeColumns(const FrontLayout& front, const FrontLayout& child) {
  for (const RowRun& columns : child.to_columns) {
    for (int c = 0; c < columns.length; ++c) {
      const int column = columns.from + c;
      const double* from = Update(child) + StripOffset(child.padded_update_rows, column);
      double* to = Panel(front) + static_cast<std::ptrdiff_t>(front.ColumnOfRow(columns.to + c)) *
                                      front.panel_stride;
      AddRuns(child.to_columns, column, from, to);
      AddRuns(child.to_update, column, from, to + front.below_row);
    }
  }
}

// Adds the part of a child's update that belongs to the parent's own update.
void MultifrontalFactor::TakeUpdate(const FrontLayout& front, const FrontLayout& child) {
  for (const RowRun& columns : child.to_update) {
    for (int c = 0; c < columns.length; ++c) {
      const int column = columns.from + c;
      AddRuns(child.to_update,
              column,
              Update(child) + StripOffset(child.padded_update_rows, column),
              Update(front) + StripOffset(front.padded_update_rows, columns.to + c));
    }
  }
}

// Computes the update -L21 L21^T of a front; dual columns contribute with the opposite sign.
void MultifrontalFactor::MakeUpdate(const FrontLayout& front, int num_threads) {
  OuterProduct primal;
  primal.width = front.width - front.dual_width;
  primal.rows = front.padded_update_rows;
  primal.L21 = PrimalPanel(front) + front.below_row - front.own_row;
  primal.stride = front.panel_stride;
  primal.update = Update(front);
  OuterProduct dual = primal;
  dual.width = front.dual_width;
  dual.L21 = Panel(front) + front.below_row;
  dual.sign = 1.0;
  dual.accumulate = true;
  const auto make = [&](int first, int last) {
    AddOuterProduct(primal, first, last);
    if (front.dual_width > 0) AddOuterProduct(dual, first, last);
  };
  const int rows = front.padded_update_rows;
  if (num_threads <= 1 || 0.5 * front.width * rows * double(rows) < kParallelUpdate) {
    make(0, rows);
    return;
  }
  // The strips are short because columns become shorter from left to right.
  const int num_strips = rows / kRowUnit;
  std::atomic<int> next{0};
  ParallelFor(num_threads, num_threads, [&](int, int) {
    constexpr int kStrips = 4;
    for (int s = next.fetch_add(kStrips); s < num_strips; s = next.fetch_add(kStrips)) {
      make(s * kRowUnit, std::min(num_strips, s + kStrips) * kRowUnit);
    }
  });
}

// Factorises L S L^T with S = -1 for dual columns. Their sign is changed, so that they can be
// factorised like the other columns; their contribution to the rest is then added and not
// subtracted.
bool MultifrontalFactor::FactorizeOwnColumns(const FrontLayout& front) {
  double* panel = Panel(front);
  if (front.dual_width > 0) {
    const std::size_t size = static_cast<std::size_t>(front.panel_stride) * front.dual_width;
    for (std::size_t i = 0; i < size; ++i) panel[i] = -panel[i];
    if (!FactorizePanel(front.dual_width, front.panel_rows(), front.panel_stride, panel)) {
      return false;
    }
    OuterProduct dual;
    dual.width = front.dual_width;
    dual.rows = front.panel_rows() - front.own_row;
    dual.L21 = panel + front.own_row;
    dual.stride = front.panel_stride;
    dual.sign = 1.0;
    dual.accumulate = true;
    dual.update = PrimalPanel(front);
    dual.update_stride = front.panel_stride;
    AddOuterProduct(dual, 0, front.width - front.dual_width);
  }
  return FactorizePanel(front.width - front.dual_width,
                        front.panel_rows() - front.own_row,
                        front.panel_stride,
                        PrimalPanel(front));
}

// Assembles a front from the matrix and from its children, eliminates its own columns and computes
// the update for its parent.
bool MultifrontalFactor::FactorizeFront(int f,
                                        const double* values,
                                        const Eigen::VectorXd& diagonal,
                                        int num_threads) {
  const FrontLayout& front = layout_.fronts[f];
  std::fill_n(Panel(front), static_cast<std::size_t>(front.panel_stride) * front.width, 0.0);
  TakePieces(front, values, diagonal);
  for (const int child : front.children) TakeColumns(front, layout_.fronts[child]);
  if (!FactorizeOwnColumns(front)) return false;
  if (front.update_rows == 0) return true;
  MakeUpdate(front, num_threads);
  for (const int child : front.children) TakeUpdate(front, layout_.fronts[child]);
  return true;
}

void MultifrontalFactor::PlaceUpdate(int f, int thread) {
  const FrontLayout& front = layout_.fronts[f];
  update_places_[f] = memory_->updates.data() + front.update;
  if (!front.is_kept) update_places_[f] += layout_.kept_size + thread * layout_.stack_size;
}

// Computes all fronts with one thread, which needs less memory than tasks do.
bool MultifrontalFactor::FactorizeInOrder(const double* values,
                                          const Eigen::VectorXd& diagonal,
                                          const std::function<bool()>& should_stop) {
  memory_->updates.Require(layout_.serial_size);
  for (int f = 0; f < static_cast<int>(layout_.fronts.size()); ++f) {
    if (should_stop && should_stop()) return false;
    update_places_[f] = memory_->updates.data() + layout_.fronts[f].serial_update;
    if (!FactorizeFront(f, values, diagonal, 1)) return false;
  }
  return true;
}

bool MultifrontalFactor::Factorize(const double* values,
                                   const Eigen::VectorXd& diagonal,
                                   int num_threads,
                                   const std::function<bool()>& should_stop) {
  const int num_tasks = static_cast<int>(layout_.tasks.size());
  const int task_threads = std::max(1, std::min(num_threads, num_tasks));
  if (task_threads == 1) return FactorizeInOrder(values, diagonal, should_stop);
  memory_->updates.Require(layout_.kept_size + task_threads * layout_.stack_size);
  std::atomic<bool> ok{true};
  std::atomic<int> next{0};
  ParallelFor(task_threads, task_threads, [&](int begin, int end) {
    for (int thread = begin; thread < end; ++thread) {
      for (int t = next++; t < num_tasks && ok; t = next++) {
        for (int f = layout_.tasks[t].first; f < layout_.tasks[t].last && ok; ++f) {
          if (thread == 0 && should_stop && should_stop()) ok = false;
          PlaceUpdate(f, thread);
          if (!FactorizeFront(f, values, diagonal, 1)) ok = false;
        }
      }
    }
  });
  int task = 0;
  for (int f = 0; f < static_cast<int>(layout_.fronts.size()) && ok; ++f) {
    if (task < num_tasks && layout_.tasks[task].first == f) {
      f = layout_.tasks[task++].last - 1;
      continue;
    }
    if (should_stop && should_stop()) ok = false;
    PlaceUpdate(f, 0);
    if (!FactorizeFront(f, values, diagonal, num_threads)) ok = false;
  }
  return ok;
}

}  // namespace ceres_ed
