#include "ceres_ed/solver/block_structure.h"

#include <algorithm>

namespace ceres_ed {

BlockStructure::BlockStructure(std::vector<int> sizes,
                               const std::vector<std::pair<int, int>>& pairs)
    : sizes_(std::move(sizes)) {
  row_offsets_.push_back(0);
  for (const int size : sizes_) row_offsets_.push_back(row_offsets_.back() + size);
  // (column, row) in the lower triangle, so that sorting gives the order of storage.
  std::vector<std::pair<int, int>> entries;
  entries.reserve(pairs.size() + sizes_.size());
  for (int i = 0; i < num_blocks(); ++i) entries.emplace_back(i, i);
  for (const auto& [a, b] : pairs) entries.emplace_back(std::min(a, b), std::max(a, b));
  std::sort(entries.begin(), entries.end());
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
  column_begins_.assign(num_blocks() + 1, 0);
  value_offsets_.push_back(0);
  for (const auto& [column, row] : entries) {
    entry_rows_.push_back(row);
    ++column_begins_[column + 1];
    value_offsets_.push_back(value_offsets_.back() +
                             static_cast<std::size_t>(sizes_[row]) * sizes_[column]);
  }
  for (int j = 0; j < num_blocks(); ++j) column_begins_[j + 1] += column_begins_[j];
}

int BlockStructure::FindEntry(int row, int column) const {
  const auto begin = entry_rows_.begin() + column_begins_[column];
  const auto end = entry_rows_.begin() + column_begins_[column + 1];
  const auto found = std::lower_bound(begin, end, row);
  return found != end && *found == row ? static_cast<int>(found - entry_rows_.begin()) : -1;
}

Eigen::VectorXd BlockStructure::Diagonal(const std::vector<double>& values) const {
  Eigen::VectorXd diagonal(num_rows());
  for (int j = 0; j < num_blocks(); ++j) {
    const double* block = &values[value_offset(column_begin(j))];
    for (int i = 0; i < size(j); ++i) diagonal[row_offset(j) + i] = block[i * size(j) + i];
  }
  return diagonal;
}

}  // namespace ceres_ed
