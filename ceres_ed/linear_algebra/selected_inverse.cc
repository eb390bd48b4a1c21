#include "ceres_ed/linear_algebra/selected_inverse.h"

#include <algorithm>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// Returns, for each row of a child's update, the row of the parent's front, whose own columns come
// first.
std::vector<int> RowsInParent(const FrontLayout& child, const FrontLayout& parent) {
  std::vector<int> rows(child.update_rows);
  for (const RowRun& run : child.to_columns) {
    for (int i = 0; i < run.length; ++i) rows[run.from + i] = parent.ColumnOfRow(run.to + i);
  }
  for (const RowRun& run : child.to_update) {
    for (int i = 0; i < run.length; ++i) rows[run.from + i] = parent.width + run.to + i;
  }
  return rows;
}

// Returns Z on all rows of a front, own columns first. `Z_UU` is Z on the rows below them.
Eigen::MatrixXd InvertFront(const MultifrontalFactor& factor,
                            const FrontLayout& front,
                            const Eigen::MatrixXd& Z_UU) {
  const int w = front.width;
  const int u = front.update_rows;
  Eigen::MatrixXd Z(w + u, w + u);
  const auto L_PP = factor.OwnColumns(front).triangularView<Eigen::Lower>();
  const Eigen::MatrixXd inverse = L_PP.solve(Eigen::MatrixXd::Identity(w, w));
  Z.topLeftCorner(w, w).noalias() = inverse.transpose() * inverse;
  if (u == 0) return Z;
  // Y = L_UP L_PP^-1, Z_UP = -Z_UU Y, and Y^T Z_UU Y is added to Z_PP.
  const Eigen::MatrixXd Y = L_PP.solve<Eigen::OnTheRight>(Eigen::MatrixXd(factor.Below(front)));
  Z.bottomRightCorner(u, u) = Z_UU;
  Z.bottomLeftCorner(u, w).noalias() = -Z_UU * Y;
  Z.topRightCorner(w, u) = Z.bottomLeftCorner(u, w).transpose();
  Z.topLeftCorner(w, w).noalias() -= Y.transpose() * Z.bottomLeftCorner(u, w);
  return Z;
}

}  // namespace

SelectedInverse::SelectedInverse(const BlockStructure& structure,
                                 const BlockVertices& vertices,
                                 const MultifrontalFactor& factor)
    : structure_(structure),
      vertices_(vertices),
      layout_(factor.layout()),
      front_of_vertex_(vertices.size()) {
  CHECK_EQ(structure.num_dual(), 0);
  for (int v = 0; v < vertices.size(); ++v) {
    if (vertices[v].offset == 0) first_vertex_.push_back(v);
    const auto after = std::upper_bound(
        layout_.fronts.begin(),
        layout_.fronts.end(),
        layout_.positions[v],
        [](int position, const FrontLayout& front) { return position < front.first_position; });
    front_of_vertex_[v] = static_cast<int>(after - layout_.fronts.begin()) - 1;
  }
  first_vertex_.push_back(vertices.size());

  const int num_fronts = static_cast<int>(layout_.fronts.size());
  std::vector<int> parent(num_fronts, -1);
  std::size_t size = 0;
  for (int f = 0; f < num_fronts; ++f) {
    const FrontLayout& front = layout_.fronts[f];
    for (const int child : front.children) parent[child] = f;
    begins_.push_back(size);
    size += static_cast<std::size_t>(front.width + front.update_rows) * front.width;
  }
  values_.resize(size);
  // Children come before their parents. The loop therefore visits a front before its children, and
  // visits its first child last, after which the full matrix of the front is no longer needed.
  std::vector<Eigen::MatrixXd> full(num_fronts);
  for (int f = num_fronts - 1; f >= 0; --f) {
    const FrontLayout& front = layout_.fronts[f];
    Eigen::MatrixXd Z_UU(front.update_rows, front.update_rows);
    if (front.update_rows > 0) {
      const std::vector<int> rows = RowsInParent(front, layout_.fronts[parent[f]]);
      const Eigen::MatrixXd& from = full[parent[f]];
      for (int c = 0; c < front.update_rows; ++c) {
        for (int r = 0; r < front.update_rows; ++r) Z_UU(r, c) = from(rows[r], rows[c]);
      }
    }
    full[f] = InvertFront(factor, front, Z_UU);
    std::copy_n(full[f].data(), full[f].rows() * front.width, values_.data() + begins_[f]);
    if (front.children.empty()) full[f].resize(0, 0);
    if (parent[f] >= 0 && layout_.fronts[parent[f]].children.front() == f) {
      full[parent[f]].resize(0, 0);
    }
  }
}

Eigen::Map<const Eigen::MatrixXd> SelectedInverse::Panel(int front) const {
  const FrontLayout& layout = layout_.fronts[front];
  return {values_.data() + begins_[front], layout.width + layout.update_rows, layout.width};
}

int SelectedInverse::FindRow(int front, int vertex) const {
  const FrontLayout& layout = layout_.fronts[front];
  const int position = layout_.positions[vertex];
  if (front_of_vertex_[vertex] == front) return position - layout.first_position;
  for (const RowRun& run : layout.below) {
    if (position >= run.to && position < run.to + run.length) {
      return layout.width + run.from + position - run.to;
    }
  }
  return -1;
}

bool SelectedInverse::Block(int row, int column, Eigen::MatrixXd* block) const {
  block->resize(structure_.size(row), structure_.size(column));
  bool complete = true;
  for (int r = first_vertex_[row]; r < first_vertex_[row + 1]; ++r) {
    for (int c = first_vertex_[column]; c < first_vertex_[column + 1]; ++c) {
      auto part = block->block(
          vertices_[r].offset, vertices_[c].offset, vertices_[r].size, vertices_[c].size);
      const bool transposed = layout_.positions[r] < layout_.positions[c];
      const int first = transposed ? r : c;
      const int later = transposed ? c : r;
      const int front = front_of_vertex_[first];
      const int place = FindRow(front, later);
      if (place < 0) {
        part.setZero();
        complete = false;
        continue;
      }
      const auto values =
          Panel(front).block(place,
                             layout_.positions[first] - layout_.fronts[front].first_position,
                             vertices_[later].size,
                             vertices_[first].size);
      if (transposed) {
        part = values.transpose();
      } else {
        part = values;
      }
    }
  }
  return complete;
}

void SelectedInverse::AddScaled(double factor, const SelectedInverse& other) {
  CHECK_EQ(values_.size(), other.values_.size());
  for (std::size_t i = 0; i < values_.size(); ++i) values_[i] += factor * other.values_[i];
}

}  // namespace ceres_ed
