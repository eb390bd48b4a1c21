#include "ceres_ed/linear_algebra/block_structure.h"

#include <algorithm>
#include <utility>

namespace ceres_ed {
namespace {

// Returns `pairs` in a stable order by `key`, whose values lie in [0, num_keys).
template <typename Key>
std::vector<BlockPair> CountingSort(const std::vector<BlockPair>& pairs, int num_keys, Key key) {
  std::vector<int> next(num_keys + 1, 0);
  for (const BlockPair& pair : pairs) ++next[key(pair) + 1];
  for (int k = 0; k < num_keys; ++k) next[k + 1] += next[k];
  std::vector<BlockPair> sorted(pairs.size());
  for (const BlockPair& pair : pairs) sorted[next[key(pair)]++] = pair;
  return sorted;
}

// Returns the entries of the lower triangle with its diagonal, sorted by column and then by row,
// each entry once.
std::vector<BlockPair> SortedEntries(int num_blocks, const std::vector<BlockPair>& pairs) {
  std::vector<BlockPair> all;
  all.reserve(pairs.size() + num_blocks);
  for (int i = 0; i < num_blocks; ++i) all.push_back({i, i, true});
  for (const auto& [a, b, head_pair] : pairs) {
    all.push_back({std::max(a, b), std::min(a, b), head_pair});
  }
  all = CountingSort(all, num_blocks, [](const BlockPair& pair) { return pair.row; });
  all = CountingSort(all, num_blocks, [](const BlockPair& pair) { return pair.column; });
  std::size_t size = 0;
  for (const BlockPair& pair : all) {
    if (size > 0 && all[size - 1].row == pair.row && all[size - 1].column == pair.column) {
      all[size - 1].head_pair |= pair.head_pair;
    } else {
      all[size++] = pair;
    }
  }
  all.resize(size);
  return all;
}

}  // namespace

BlockStructure::BlockStructure(std::vector<int> sizes,
                               const std::vector<BlockPair>& pairs,
                               int num_dual)
    : sizes_(std::move(sizes)), num_dual_(num_dual) {
  row_offsets_.reserve(sizes_.size() + 1);
  row_offsets_.push_back(0);
  for (const int size : sizes_) row_offsets_.push_back(row_offsets_.back() + size);
  const std::vector<BlockPair> entries = SortedEntries(num_blocks(), pairs);
  column_begins_.assign(num_blocks() + 1, 0);
  value_offsets_.push_back(0);
  for (const BlockPair& entry : entries) {
    entry_rows_.push_back(entry.row);
    head_pairs_.push_back(entry.head_pair ? 1 : 0);
    ++column_begins_[entry.column + 1];
    value_offsets_.push_back(value_offsets_.back() +
                             static_cast<std::size_t>(sizes_[entry.row]) * sizes_[entry.column]);
  }
  for (int j = 0; j < num_blocks(); ++j) column_begins_[j + 1] += column_begins_[j];
}

int BlockStructure::FindEntry(int row, int column) const {
  const auto begin = entry_rows_.begin() + column_begins_[column];
  const auto end = entry_rows_.begin() + column_begins_[column + 1];
  const auto found = std::lower_bound(begin, end, row);
  return found != end && *found == row ? static_cast<int>(found - entry_rows_.begin()) : -1;
}

std::vector<BlockPair> BlockStructure::Pairs() const {
  std::vector<BlockPair> pairs;
  pairs.reserve(num_entries() - num_blocks());
  for (int j = 0; j < num_blocks(); ++j) {
    for (int e = column_begin(j) + 1; e < column_begin(j + 1); ++e) {
      pairs.push_back({entry_row(e), j, head_pair(e)});
    }
  }
  return pairs;
}

Eigen::VectorXd BlockStructure::Diagonal(const std::vector<double>& values) const {
  Eigen::VectorXd diagonal(num_rows());
  for (int j = 0; j < num_blocks(); ++j) {
    const double* block = &values[value_offset(column_begin(j))];
    for (int i = 0; i < size(j); ++i) diagonal[row_offset(j) + i] = block[i * size(j) + i];
    if (num_dual_ == 0 || is_dual(j)) continue;
    for (int e = column_begin(j) + 1; e < column_begin(j + 1); ++e) {
      if (!is_dual(entry_row(e))) continue;
      const Eigen::Map<const Eigen::MatrixXd> jacobian(
          &values[value_offset(e)], size(entry_row(e)), size(j));
      diagonal.segment(row_offset(j), size(j)) += jacobian.colwise().squaredNorm().transpose();
    }
  }
  return diagonal;
}

}  // namespace ceres_ed
