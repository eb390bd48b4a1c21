#include "ceres_ed/linear_algebra/iterative/incomplete_cholesky.h"

#include <algorithm>

#include <Eigen/Cholesky>

namespace ceres_ed {
namespace {

// The increases of the diagonal that are tried, relative to it.
constexpr double kShifts[] = {0.0, 1e-3, 1e-2, 0.1, 1.0, 10.0};

}  // namespace

IncompleteCholesky::IncompleteCholesky(const PrimalMatrix& matrix) : matrix_(matrix) {
  const BlockStructure& structure = matrix.structure();
  places_.resize(structure.num_entries());
  std::size_t size = 0;
  for (int column = 0; column < matrix.num_blocks(); ++column) {
    int end = structure.column_begin(column);
    for (; end < structure.column_begin(column + 1) && !structure.is_dual(structure.entry_row(end));
         ++end) {
      places_[end] = size;
      size += static_cast<std::size_t>(structure.size(structure.entry_row(end))) *
              structure.size(column);
    }
    ends_.push_back(end);
  }
  values_.resize(size);
}

IncompleteCholesky::Block IncompleteCholesky::At(int entry, int column) {
  const BlockStructure& structure = matrix_.structure();
  return {
      &values_[places_[entry]], structure.size(structure.entry_row(entry)), structure.size(column)};
}

void IncompleteCholesky::Take(double scale) {
  const BlockStructure& structure = matrix_.structure();
  for (int column = 0; column < matrix_.num_blocks(); ++column) {
    const int begin = structure.column_begin(column);
    Block diagonal = At(begin, column);
    diagonal = matrix_.DiagonalBlock(column);
    diagonal.diagonal() *= scale;
    for (int e = begin + 1; e < End(column); ++e) {
      Block block = At(e, column);
      std::copy_n(matrix_.values(e), block.size(), block.data());
    }
  }
}

bool IncompleteCholesky::Factorize() {
  const BlockStructure& structure = matrix_.structure();
  for (int column = 0; column < matrix_.num_blocks(); ++column) {
    const int begin = structure.column_begin(column);
    Block diagonal = At(begin, column);
    const Eigen::LLT<Eigen::MatrixXd> factor(diagonal);
    if (factor.info() != Eigen::Success) return false;
    diagonal = factor.matrixLLT();
    for (int e = begin + 1; e < End(column); ++e) {
      Block block = At(e, column);
      diagonal.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(block);
    }
    SubtractProducts(column);
  }
  return true;
}

// Subtracts L_ik L_jk^T from the blocks (i, j) that exist, for column k.
void IncompleteCholesky::SubtractProducts(int column) {
  const BlockStructure& structure = matrix_.structure();
  for (int e = structure.column_begin(column) + 1; e < End(column); ++e) {
    const int j = structure.entry_row(e);
    const Block right = At(e, column);
    int target = structure.column_begin(j);
    for (int f = e; f < End(column); ++f) {
      const int i = structure.entry_row(f);
      while (target < End(j) && structure.entry_row(target) < i) ++target;
      if (target == End(j)) break;
      if (structure.entry_row(target) != i) continue;
      At(target, j).noalias() -= At(f, column).lazyProduct(right.transpose());
    }
  }
}

bool IncompleteCholesky::Update(int /*num_threads*/) {
  for (const double shift : kShifts) {
    Take(1.0 + shift);
    if (Factorize()) return true;
  }
  return false;
}

void IncompleteCholesky::Apply(const Eigen::VectorXd& x, int /*num_threads*/, Eigen::VectorXd* y) {
  const BlockStructure& structure = matrix_.structure();
  *y = x;
  const auto rows = [&](int block) {
    return y->segment(structure.row_offset(block), structure.size(block));
  };
  for (int column = 0; column < matrix_.num_blocks(); ++column) {
    const int begin = structure.column_begin(column);
    auto own = rows(column);
    At(begin, column).triangularView<Eigen::Lower>().solveInPlace(own);
    for (int e = begin + 1; e < End(column); ++e) {
      rows(structure.entry_row(e)).noalias() -= At(e, column).lazyProduct(own);
    }
  }
  for (int column = matrix_.num_blocks() - 1; column >= 0; --column) {
    const int begin = structure.column_begin(column);
    auto own = rows(column);
    for (int e = begin + 1; e < End(column); ++e) {
      own.noalias() -= At(e, column).transpose().lazyProduct(rows(structure.entry_row(e)));
    }
    At(begin, column).triangularView<Eigen::Lower>().transpose().solveInPlace(own);
  }
}

}  // namespace ceres_ed
