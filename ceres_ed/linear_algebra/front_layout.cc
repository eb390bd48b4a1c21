#include "ceres_ed/linear_algebra/front_layout.h"

#include <ceres_ed/linear_algebra/front_kernels.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace ceres_ed {
namespace {

// A tree with fewer operations than kOneTask is one task; others are divided into at least
// kMinTasks tasks.
constexpr double kOneTask = 2e7;
constexpr int kMinTasks = 12;
// A stride that is a multiple of a page would map all columns to the same cache lines.
constexpr int kPageDoubles = 512;

int StrideFor(int rows) { return rows % kPageDoubles == 0 && rows > 0 ? rows + kRowUnit : rows; }

void AppendRow(int from, int to, int length, std::vector<RowRun>* runs) {
  if (!runs->empty() && runs->back().from + runs->back().length == from &&
      // Appends a row to `runs`: extends the last run if the new rows continue it, else starts a
      // new run.
      runs->back().to + runs->back().length == to) {
    runs->back().length += length;
  } else {
    runs->push_back({from, to, length});
  }
}

class Planner {
 public:
  Planner(const BlockVertices& vertices,
          const std::vector<BlockPiece>& pieces,
          const std::vector<Front>& fronts)
      : vertices_(vertices), source_pieces_(pieces), fronts_(fronts) {}

  FactorLayout Plan() {
    PlacePanels();
    PlaceRuns();
    PlacePieces();
    ChooseTasks();
    PlaceUpdates();
    return std::move(layout_);
  }

 private:
  void PlacePanels();
  void PlaceRuns();
  void PlacePieces();
  void ChooseTasks();
  void PlaceUpdates();
  void PlaceUpdatesOf(const std::vector<int>& fronts);

  const BlockVertices& vertices_;
  const std::vector<BlockPiece>& source_pieces_;
  const std::vector<Front>& fronts_;
  FactorLayout layout_;
  // For each vertex: the front that eliminates it, and its column in that front.
  std::vector<int> front_of_;
  std::vector<int> column_of_;
};

void Planner::PlacePanels() {
  layout_.positions.resize(vertices_.size());
  front_of_.resize(vertices_.size());
  column_of_.resize(vertices_.size());
  layout_.fronts.resize(fronts_.size());
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    const Front& front = fronts_[f];
    FrontLayout& place = layout_.fronts[f];
    place.dual_width = front.dual_width;
    place.width = front.width;
    place.own_row = RoundUpRows(front.dual_width);
    place.update_rows = front.height - front.width;
    place.padded_update_rows = RoundUpRows(place.update_rows);
    place.below_row = place.own_row + RoundUpRows(place.width - place.dual_width);
    place.panel_stride = StrideFor(place.panel_rows());
    place.panel = layout_.panel_size;
    layout_.panel_size += static_cast<std::size_t>(place.panel_stride) * place.width;
    layout_.max_panel_rows = std::max(layout_.max_panel_rows, place.panel_rows());
    layout_.operations += FrontOperations(front.width, front.height);
    place.first_position = layout_.num_rows;
    for (const int v : front.columns) {
      front_of_[v] = static_cast<int>(f);
      column_of_[v] = layout_.num_rows - place.first_position;
      layout_.positions[v] = layout_.num_rows;
      layout_.num_rows += vertices_[v].size;
    }
    if (front.parent >= 0) layout_.fronts[front.parent].children.push_back(static_cast<int>(f));
  }
}

void Planner::PlaceRuns() {
  // The row of each vertex in the update of the current front.
  std::vector<int> row_of(vertices_.size(), -1);
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    int row = 0;
    for (const int v : fronts_[f].below) {
      row_of[v] = row;
      AppendRow(row, layout_.positions[v], vertices_[v].size, &layout_.fronts[f].below);
      row += vertices_[v].size;
    }
    for (const int child : layout_.fronts[f].children) {
      int from = 0;
      for (const int v : fronts_[child].below) {
        const int length = vertices_[v].size;
        if (front_of_[v] == static_cast<int>(f)) {
          const int to = layout_.fronts[f].RowOfColumn(column_of_[v]);
          AppendRow(from, to, length, &layout_.fronts[child].to_columns);
        } else {
          AppendRow(from, row_of[v], length, &layout_.fronts[child].to_update);
        }
        from += length;
      }
    }
  }
}

void Planner::PlacePieces() {
  std::vector<PanelPiece>& pieces = layout_.pieces;
  pieces.reserve(source_pieces_.size());
  // The pieces of each front, in their order: those of front f end at ends[f].
  const auto front_of = [&](const BlockPiece& piece) {
    return std::min(front_of_[piece.row], front_of_[piece.column]);
  };
  std::vector<int> ends(fronts_.size() + 1, 0);
  for (const BlockPiece& piece : source_pieces_) ++ends[front_of(piece) + 1];
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<int> by_front(source_pieces_.size());
  for (std::size_t p = 0; p < source_pieces_.size(); ++p) {
    by_front[ends[front_of(source_pieces_[p])]++] = static_cast<int>(p);
  }
  std::vector<int> row_of(vertices_.size(), -1);
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    FrontLayout& place = layout_.fronts[f];
    int below = place.below_row;
    for (const int v : fronts_[f].below) {
      row_of[v] = below;
      below += vertices_[v].size;
    }
    for (const int v : fronts_[f].columns) row_of[v] = place.RowOfColumn(column_of_[v]);
    place.first_piece = static_cast<int>(pieces.size());
    for (int p = f == 0 ? 0 : ends[f - 1]; p < ends[f]; ++p) {
      const BlockPiece& source = source_pieces_[by_front[p]];
      const bool transposed = layout_.positions[source.row] < layout_.positions[source.column];
      const int row = transposed ? source.column : source.row;
      const int col = transposed ? source.row : source.column;
      pieces.push_back({source.value,
                        source.stride,
                        vertices_[row].size,
                        vertices_[col].size,
                        row_of[row],
                        column_of_[col],
                        transposed});
    }
    place.last_piece = static_cast<int>(pieces.size());
  }
}

// Chooses disjoint subtrees of about equal work as tasks: subtrees with more than 1 / kMinTasks of
// the operations are cut into those of their children.
void Planner::ChooseTasks() {
  const int n = static_cast<int>(fronts_.size());
  std::vector<double> work(n);
  std::vector<int> begin(n);
  std::vector<int> roots;
  for (int f = 0; f < n; ++f) {
    work[f] += FrontOperations(fronts_[f].width, fronts_[f].height);
    begin[f] = layout_.fronts[f].children.empty() ? f : begin[layout_.fronts[f].children.front()];
    if (fronts_[f].parent >= 0) {
      work[fronts_[f].parent] += work[f];
    } else {
      roots.push_back(f);
    }
  }
  if (layout_.operations < kOneTask) {
    if (n > 0) layout_.tasks.push_back({0, n});
    return;
  }
  const double enough = layout_.operations / kMinTasks;
  std::vector<int> open = roots;
  while (!open.empty()) {
    const int f = open.back();
    open.pop_back();
    if (work[f] <= enough) {
      layout_.tasks.push_back({begin[f], f + 1});
    } else {
      const std::vector<int>& children = layout_.fronts[f].children;
      open.insert(open.end(), children.begin(), children.end());
    }
  }
  std::sort(layout_.tasks.begin(), layout_.tasks.end(), [](const FrontTask& a, const FrontTask& b) {
    return a.first < b.first;
  });
}

// Puts the updates of fronts at even and at odd depth on two separate stacks. When a front has been
// computed, the updates of its children are therefore on top of the other stack and can be removed.
void Planner::PlaceUpdatesOf(const std::vector<int>& fronts) {
  std::vector<char> here(fronts_.size(), 0);
  for (const int f : fronts) here[f] = 1;
  std::vector<char> parity(fronts_.size(), 0);
  for (auto f = fronts.rbegin(); f != fronts.rend(); ++f) {
    const int parent = fronts_[*f].parent;
    if (parent >= 0 && here[parent] != 0) parity[*f] = parity[parent] == 0 ? 1 : 0;
  }
  std::array<std::size_t, 2> top = {0, 0};
  std::array<std::size_t, 2> highest = {0, 0};
  const auto size = [&](int f) { return StripsSize(layout_.fronts[f].padded_update_rows); };
  for (const int f : fronts) {
    const std::size_t stack = parity[f] == 0 ? 0 : 1;
    const int parent = fronts_[f].parent;
    FrontLayout& place = layout_.fronts[f];
    // An update that is needed by another task is kept at a place where nothing overwrites it.
    place.is_kept = parent >= 0 && here[parent] == 0;
    std::size_t& end = place.is_kept ? layout_.kept_size : top[stack];
    place.update = end;
    end += size(f);
    highest[stack] = std::max(highest[stack], top[stack]);
    for (const int child : place.children) {
      if (here[child] != 0) top[1 - stack] -= size(child);
    }
  }
  for (const int f : fronts) {
    if (!layout_.fronts[f].is_kept && parity[f] != 0) layout_.fronts[f].update += highest[0];
  }
  layout_.stack_size = std::max(layout_.stack_size, highest[0] + highest[1]);
}

void Planner::PlaceUpdates() {
  std::vector<int> all(fronts_.size());
  std::iota(all.begin(), all.end(), 0);
  PlaceUpdatesOf(all);
  for (FrontLayout& front : layout_.fronts) front.serial_update = front.update;
  layout_.serial_size = layout_.stack_size;
  layout_.stack_size = 0;
  std::vector<char> in_task(fronts_.size(), 0);
  for (const FrontTask& task : layout_.tasks) {
    std::vector<int> fronts;
    for (int f = task.first; f < task.last; ++f) {
      fronts.push_back(f);
      in_task[f] = 1;
    }
    PlaceUpdatesOf(fronts);
  }
  std::vector<int> rest;
  for (int f = 0; f < static_cast<int>(fronts_.size()); ++f) {
    if (in_task[f] == 0) rest.push_back(f);
  }
  PlaceUpdatesOf(rest);
}

}  // namespace

FactorLayout LayOutFactor(const BlockVertices& vertices,
                          const std::vector<BlockPiece>& pieces,
                          const std::vector<Front>& fronts) {
  return Planner(vertices, pieces, fronts).Plan();
}

}  // namespace ceres_ed
