#include "ceres_ed/solver/block_cholesky.h"

#include <ceres_ed/solver/double_buffer.h>
#include <ceres_ed/solver/front_kernels.h>
#include <ceres_ed/solver/front_layout.h>
#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// Updates of fewer multiplications are not worth a second thread.
constexpr double kParallelUpdate = 4e6;

// A factor of fewer multiplications than this takes less time than a better order of it.
constexpr double kSmallFactor = 5e8;

double NumOperations(const std::vector<Front>& fronts) {
  double operations = 0.0;
  for (const Front& front : fronts) operations += FrontOperations(front.width, front.height);
  return operations;
}

FactorLayout LayOut(const BlockStructure& structure,
                    const BlockVertices& vertices,
                    int num_trailing) {
  const std::vector<BlockPiece> pieces = vertices.Pieces(structure);
  const RowGraph graph = vertices.Graph(pieces);
  const auto fronts_by = [&](OrderingMethod method) {
    const std::vector<int> order =
        FillReducingOrder(graph, vertices.is_affine(), num_trailing, method);
    return BuildFronts(graph, order, num_trailing);
  };
  std::vector<Front> fronts = fronts_by(OrderingMethod::kMinimumDegree);
  if (HasNestedDissection() && NumOperations(fronts) > kSmallFactor) {
    std::vector<Front> other = fronts_by(OrderingMethod::kNestedDissection);
    if (NumOperations(other) < NumOperations(fronts)) fronts = std::move(other);
  }
  return LayOutFactor(vertices, pieces, fronts);
}

// Adds rows [begin, ...) of a column of a child's update to a column of its parent.
void AddRuns(const std::vector<RowRun>& runs, int begin, const double* from, double* to) {
  for (const RowRun& run : runs) {
    const int skipped = std::max(0, begin - run.from);
    for (int i = skipped; i < run.length; ++i) to[run.to + i] += from[run.from + i];
  }
}

}  // namespace

struct BlockCholesky::Impl {
  Impl(const BlockStructure& block_structure, int trailing)
      : structure(block_structure),
        num_trailing_rows(structure.num_rows() -
                          structure.row_offset(structure.num_blocks() - trailing)),
        vertices(structure, trailing),
        layout(LayOut(structure, vertices, trailing)),
        panels(layout.panel_size),
        updates(layout.kept_size + layout.stack_size),
        update_places(layout.fronts.size()),
        ordered(layout.num_rows),
        below(layout.max_update_rows) {}

  bool Factorize(const double* values, const Eigen::VectorXd& diagonal, int num_threads);
  bool FactorizeFront(int f, const double* values, int num_threads);
  void TakePieces(const FrontLayout& front, const double* values);
  void TakeColumns(const FrontLayout& front, const FrontLayout& child);
  void TakeUpdate(const FrontLayout& front, const FrontLayout& child);
  void MakeUpdate(const FrontLayout& front, int num_threads);

  double* Panel(const FrontLayout& front) const { return panels.data() + front.panel; }
  double* Update(const FrontLayout& front) const {
    return update_places[&front - layout.fronts.data()];
  }
  void PlaceUpdate(int f, int thread);

  void ToOrdered(const Eigen::VectorXd& rows);
  Eigen::VectorXd FromOrdered() const;
  void SolveForward();
  void SolveBackward();
  Eigen::MatrixXd TrailingFactor() const;

  const BlockStructure& structure;
  const int num_trailing_rows;
  const BlockVertices vertices;
  const FactorLayout layout;
  const DoubleBuffer panels;
  // Those that outlive their task, then a stack of each thread.
  DoubleBuffer updates;
  // Of each front: where its update is.
  std::vector<double*> update_places;
  // Rows in the order of elimination: what is added to the diagonal, then what is solved for.
  Eigen::VectorXd ordered;
  // Rows below a front's own.
  Eigen::VectorXd below;
};

void BlockCholesky::Impl::TakePieces(const FrontLayout& front, const double* values) {
  double* panel = Panel(front);
  for (int p = front.first_piece; p < front.last_piece; ++p) {
    const PanelPiece& piece = layout.pieces[p];
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
    panel[static_cast<std::ptrdiff_t>(c) * front.panel_stride + c] +=
        ordered[front.first_position + c];
  }
}

// What a child's update has for the columns of its parent.
void BlockCholesky::Impl::TakeColumns(const FrontLayout& front, const FrontLayout& child) {
  for (const RowRun& columns : child.to_columns) {
    for (int c = 0; c < columns.length; ++c) {
      const int column = columns.from + c;
      const double* from =
          Update(child) + static_cast<std::ptrdiff_t>(column) * child.update_stride;
      double* to = Panel(front) + static_cast<std::ptrdiff_t>(columns.to + c) * front.panel_stride;
      AddRuns(child.to_columns, column, from, to);
      AddRuns(child.to_update, column, from, to + front.below_row);
    }
  }
}

// What it has for the parent's own update.
void BlockCholesky::Impl::TakeUpdate(const FrontLayout& front, const FrontLayout& child) {
  for (const RowRun& columns : child.to_update) {
    for (int c = 0; c < columns.length; ++c) {
      const int column = columns.from + c;
      AddRuns(child.to_update,
              column,
              Update(child) + static_cast<std::ptrdiff_t>(column) * child.update_stride,
              Update(front) + static_cast<std::ptrdiff_t>(columns.to + c) * front.update_stride);
    }
  }
}

void BlockCholesky::Impl::MakeUpdate(const FrontLayout& front, int num_threads) {
  const int rows = front.padded_update_rows;
  const double* L21 = Panel(front) + front.below_row;
  const auto make = [&](int first, int last) {
    SubtractOuterProduct(front.width,
                         rows,
                         L21,
                         front.panel_stride,
                         first,
                         last,
                         Update(front),
                         front.update_stride);
  };
  if (num_threads <= 1 || 0.5 * front.width * rows * double(rows) < kParallelUpdate) {
    make(0, rows);
    return;
  }
  // Short strips, for columns get shorter from left to right.
  const int num_strips = rows / kRowUnit;
  std::atomic<int> next{0};
  ParallelFor(num_threads, num_threads, [&](int, int) {
    constexpr int kStrips = 4;
    for (int s = next.fetch_add(kStrips); s < num_strips; s = next.fetch_add(kStrips)) {
      make(s * kRowUnit, std::min(num_strips, s + kStrips) * kRowUnit);
    }
  });
}

bool BlockCholesky::Impl::FactorizeFront(int f, const double* values, int num_threads) {
  const FrontLayout& front = layout.fronts[f];
  double* panel = Panel(front);
  std::fill_n(panel, static_cast<std::size_t>(front.panel_stride) * front.width, 0.0);
  TakePieces(front, values);
  for (const int child : front.children) TakeColumns(front, layout.fronts[child]);
  if (!FactorizePanel(
          front.width, front.below_row + front.padded_update_rows, front.panel_stride, panel)) {
    return false;
  }
  if (front.update_rows == 0) return true;
  MakeUpdate(front, num_threads);
  for (const int child : front.children) TakeUpdate(front, layout.fronts[child]);
  return true;
}

void BlockCholesky::Impl::PlaceUpdate(int f, int thread) {
  const FrontLayout& front = layout.fronts[f];
  update_places[f] = updates.data() + front.update;
  if (!front.is_kept) update_places[f] += layout.kept_size + thread * layout.stack_size;
}

bool BlockCholesky::Impl::Factorize(const double* values,
                                    const Eigen::VectorXd& diagonal,
                                    int num_threads) {
  ToOrdered(diagonal);
  const int num_tasks = static_cast<int>(layout.tasks.size());
  const int task_threads = std::max(1, std::min(num_threads, num_tasks));
  const std::size_t update_size = layout.kept_size + task_threads * layout.stack_size;
  if (update_size > updates.size()) updates = DoubleBuffer(update_size);
  std::atomic<bool> ok{true};
  std::atomic<int> next{0};
  ParallelFor(task_threads, task_threads, [&](int begin, int end) {
    for (int thread = begin; thread < end; ++thread) {
      for (int t = next++; t < num_tasks && ok; t = next++) {
        for (int f = layout.tasks[t].first; f < layout.tasks[t].last && ok; ++f) {
          PlaceUpdate(f, thread);
          if (!FactorizeFront(f, values, 1)) ok = false;
        }
      }
    }
  });
  int task = 0;
  for (int f = 0; f < static_cast<int>(layout.fronts.size()) && ok; ++f) {
    if (task < num_tasks && layout.tasks[task].first == f) {
      f = layout.tasks[task++].last - 1;
      continue;
    }
    PlaceUpdate(f, 0);
    if (!FactorizeFront(f, values, num_threads)) ok = false;
  }
  return ok;
}

void BlockCholesky::Impl::ToOrdered(const Eigen::VectorXd& rows) {
  for (int v = 0; v < vertices.size(); ++v) {
    const BlockVertex& vertex = vertices[v];
    std::copy_n(rows.data() + structure.row_offset(vertex.block) + vertex.offset,
                vertex.size,
                ordered.data() + layout.positions[v]);
  }
}

Eigen::VectorXd BlockCholesky::Impl::FromOrdered() const {
  Eigen::VectorXd rows(structure.num_rows());
  for (int v = 0; v < vertices.size(); ++v) {
    const BlockVertex& vertex = vertices[v];
    std::copy_n(ordered.data() + layout.positions[v],
                vertex.size,
                rows.data() + structure.row_offset(vertex.block) + vertex.offset);
  }
  return rows;
}

void BlockCholesky::Impl::SolveForward() {
  for (const FrontLayout& front : layout.fronts) {
    const double* panel = Panel(front);
    double* x = ordered.data() + front.first_position;
    for (int c = 0; c < front.width; ++c) {
      const double* column = panel + static_cast<std::ptrdiff_t>(c) * front.panel_stride;
      x[c] /= column[c];
      for (int r = c + 1; r < front.width; ++r) x[r] -= column[r] * x[c];
    }
    if (front.update_rows == 0) continue;
    below.head(front.padded_update_rows).setZero();
    SubtractProduct(front.width,
                    front.padded_update_rows,
                    panel + front.below_row,
                    front.panel_stride,
                    x,
                    below.data());
    for (const RowRun& run : front.below) {
      for (int i = 0; i < run.length; ++i) ordered[run.to + i] += below[run.from + i];
    }
  }
}

void BlockCholesky::Impl::SolveBackward() {
  for (auto front = layout.fronts.rbegin(); front != layout.fronts.rend(); ++front) {
    const double* panel = Panel(*front);
    double* x = ordered.data() + front->first_position;
    if (front->update_rows > 0) {
      below.head(front->padded_update_rows).setZero();
      for (const RowRun& run : front->below) {
        for (int i = 0; i < run.length; ++i) below[run.from + i] = ordered[run.to + i];
      }
      SubtractTransposedProduct(front->width,
                                front->padded_update_rows,
                                panel + front->below_row,
                                front->panel_stride,
                                below.data(),
                                x);
    }
    for (int c = front->width - 1; c >= 0; --c) {
      const double* column = panel + static_cast<std::ptrdiff_t>(c) * front->panel_stride;
      double sum = x[c];
      for (int r = c + 1; r < front->width; ++r) sum -= column[r] * x[r];
      x[c] = sum / column[c];
    }
  }
}

Eigen::MatrixXd BlockCholesky::Impl::TrailingFactor() const {
  Eigen::MatrixXd trailing = Eigen::MatrixXd::Zero(num_trailing_rows, num_trailing_rows);
  if (num_trailing_rows == 0) return trailing;
  const FrontLayout& front = layout.fronts.back();
  CHECK_EQ(front.width, num_trailing_rows);
  for (int c = 0; c < front.width; ++c) {
    const double* column = Panel(front) + static_cast<std::ptrdiff_t>(c) * front.panel_stride;
    std::copy(column + c, column + front.width, &trailing(c, c));
  }
  return trailing;
}

BlockCholesky::BlockCholesky(const BlockStructure& structure, int num_trailing)
    : impl_(std::make_unique<Impl>(structure, num_trailing)) {}

BlockCholesky::~BlockCholesky() = default;

bool BlockCholesky::Factorize(const double* values,
                              const Eigen::VectorXd& diagonal,
                              int num_threads) {
  return impl_->Factorize(values, diagonal, num_threads);
}

Eigen::VectorXd BlockCholesky::Solve(const Eigen::VectorXd& rhs) {
  impl_->ToOrdered(rhs);
  impl_->SolveForward();
  impl_->SolveBackward();
  return impl_->FromOrdered();
}

Eigen::VectorXd BlockCholesky::SolveLower(const Eigen::VectorXd& rhs) {
  impl_->ToOrdered(rhs);
  impl_->SolveForward();
  return impl_->FromOrdered();
}

Eigen::VectorXd BlockCholesky::SolveUpper(const Eigen::VectorXd& rhs) {
  impl_->ToOrdered(rhs);
  impl_->SolveBackward();
  return impl_->FromOrdered();
}

Eigen::MatrixXd BlockCholesky::TrailingFactor() const { return impl_->TrailingFactor(); }

double BlockCholesky::NumOperations() const { return impl_->layout.operations; }

}  // namespace ceres_ed
