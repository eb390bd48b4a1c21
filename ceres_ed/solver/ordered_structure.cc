#include "ceres_ed/solver/ordered_structure.h"

#include <algorithm>
#include <utility>

namespace ceres_ed {
namespace {

std::vector<int> Positions(const std::vector<int>& order) {
  std::vector<int> positions(order.size());
  for (int k = 0; k < static_cast<int>(order.size()); ++k) positions[order[k]] = k;
  return positions;
}

BlockStructure Reordered(const BlockStructure& original,
                         const std::vector<int>& order,
                         const std::vector<int>& positions) {
  std::vector<int> sizes;
  sizes.reserve(order.size());
  for (const int block : order) sizes.push_back(original.size(block));
  std::vector<BlockPair> pairs;
  pairs.reserve(original.num_entries());
  for (int j = 0; j < original.num_blocks(); ++j) {
    for (int e = original.column_begin(j); e < original.column_begin(j + 1); ++e) {
      pairs.push_back({positions[original.entry_row(e)], positions[j], original.affine_pair(e)});
    }
  }
  return BlockStructure(std::move(sizes), pairs);
}

}  // namespace

OrderedStructure::OrderedStructure(const BlockStructure& original, const std::vector<int>& order)
    : original_(original),
      position_(Positions(order)),
      ordered_(Reordered(original, order, position_)) {
  std::ptrdiff_t column_start = 0;
  for (int j = 0; j < ordered_.num_blocks(); ++j) {
    std::ptrdiff_t height = 0;
    for (int e = ordered_.column_begin(j); e < ordered_.column_begin(j + 1); ++e) {
      entry_start_.push_back(column_start + height);
      height += ordered_.size(ordered_.entry_row(e));
    }
    column_height_.push_back(height);
    const int size = ordered_.size(j);
    column_start += height * size - size * (size - 1) / 2;
  }
  for (int j = 0; j < original.num_blocks(); ++j) {
    for (int e = original.column_begin(j); e < original.column_begin(j + 1); ++e) {
      const int row = position_[original.entry_row(e)];
      const int column = position_[j];
      entry_of_.push_back(ordered_.FindEntry(std::max(row, column), std::min(row, column)));
      transposed_.push_back(row < column ? 1 : 0);
    }
  }
}

void OrderedStructure::FillValues(const double* values,
                                  const Eigen::VectorXd& diagonal,
                                  double* out) const {
  for (int j = 0; j < original_.num_blocks(); ++j) {
    for (int e = original_.column_begin(j); e < original_.column_begin(j + 1); ++e) {
      const double* block = values + original_.value_offset(e);
      if (original_.entry_row(e) == j) {
        CopyDiagonal(j, entry_of_[e], block, diagonal, out);
      } else {
        CopyBlock(original_.entry_row(e), j, e, block, out);
      }
    }
  }
}

void OrderedStructure::ToOrdered(const Eigen::VectorXd& rows, double* ordered_rows) const {
  for (int j = 0; j < original_.num_blocks(); ++j) {
    std::copy_n(rows.data() + original_.row_offset(j),
                original_.size(j),
                ordered_rows + ordered_.row_offset(position_[j]));
  }
}

void OrderedStructure::FromOrdered(const double* ordered_rows, Eigen::VectorXd* rows) const {
  rows->resize(original_.num_rows());
  for (int j = 0; j < original_.num_blocks(); ++j) {
    std::copy_n(ordered_rows + ordered_.row_offset(position_[j]),
                original_.size(j),
                rows->data() + original_.row_offset(j));
  }
}

void OrderedStructure::CopyDiagonal(int block,
                                    int ordered_entry,
                                    const double* values,
                                    const Eigen::VectorXd& diagonal,
                                    double* out) const {
  const int size = original_.size(block);
  for (int c = 0; c < size; ++c) {
    double* column = out + entry_start_[ordered_entry] + ColumnShift(position_[block], c);
    for (int r = c; r < size; ++r) column[r] = values[c * size + r];
    column[c] += diagonal[original_.row_offset(block) + c];
  }
}

void OrderedStructure::CopyBlock(
    int row, int column, int entry, const double* values, double* out) const {
  const int rows = original_.size(row);
  const int columns = original_.size(column);
  const bool transposed = transposed_[entry] != 0;
  const int ordered_column = transposed ? position_[row] : position_[column];
  double* start = out + entry_start_[entry_of_[entry]];
  for (int c = 0; c < (transposed ? rows : columns); ++c) {
    double* target = start + ColumnShift(ordered_column, c);
    if (transposed) {
      for (int r = 0; r < columns; ++r) target[r] = values[r * rows + c];
    } else {
      std::copy_n(values + c * rows, rows, target);
    }
  }
}

}  // namespace ceres_ed
