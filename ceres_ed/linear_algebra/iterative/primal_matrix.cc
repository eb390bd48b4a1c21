#include "ceres_ed/linear_algebra/iterative/primal_matrix.h"

#include <ceres_ed/util/for_each_machine.h>
#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <cstddef>

namespace ceres_ed {
namespace {

// y += A x for a block of `rows` x `columns` values that is stored column by column.
inline void AddProduct(int rows, int columns, const double* A, const double* x, double* y) {
  for (int c = 0; c < columns; ++c) {
    for (int r = 0; r < rows; ++r) y[r] += A[c * rows + r] * x[c];
  }
}

// y += A^T x.
inline void AddTransposedProduct(
    int rows, int columns, const double* A, const double* x, double* y) {
  for (int c = 0; c < columns; ++c) {
    double sum = 0.0;
    for (int r = 0; r < rows; ++r) sum += A[c * rows + r] * x[r];
    y[c] += sum;
  }
}

// Four numbers that are multiplied at once, at the address of any double. (A deduced type would
// lose the alignment.)
typedef double Four __attribute__((vector_size(32), aligned(8), may_alias));

// The same for blocks of kSplitBlockSize rows and columns, most of which are those of two nodes.
static_assert(kSplitBlockSize == 12, "three times four numbers");
inline void AddNodeProduct(const double* A, const double* x, double* y) {
  Four sums[3] = {};
  for (int c = 0; c < 12; ++c) {
    const Four* column = reinterpret_cast<const Four*>(A + 12 * c);
    for (int i = 0; i < 3; ++i) sums[i] += column[i] * x[c];
  }
  for (int i = 0; i < 3; ++i) reinterpret_cast<Four*>(y)[i] += sums[i];
}

inline void AddTransposedNodeProduct(const double* A, const double* x, double* y) {
  const Four* factors = reinterpret_cast<const Four*>(x);
  for (int c = 0; c < 12; ++c) {
    const Four* column = reinterpret_cast<const Four*>(A + 12 * c);
    const Four sum = column[0] * factors[0] + column[1] * factors[1] + column[2] * factors[2];
    y[c] += (sum[0] + sum[1]) + (sum[2] + sum[3]);
  }
}

// The rows of one block in a product: y += sum of A_bj x_j. Rows of dual blocks have their factors
// in `dual`, and are skipped without it.
CERES_ED_FOR_EACH_MACHINE
void AddRow(const PrimalMatrix& A, int block, const double* x, const double* dual, double* y) {
  const BlockStructure& structure = A.structure();
  const int first_dual_row = structure.num_primal_rows();
  for (const PrimalMatrix::Neighbor* n = A.begin(block); n != A.end(block); ++n) {
    const bool is_dual = structure.is_dual(n->block);
    if (is_dual && dual == nullptr) return;
    const int row = structure.row_offset(n->block);
    const double* factor = is_dual ? dual + (row - first_dual_row) : x + row;
    const double* values = A.values(n->entry);
    const int size = structure.size(block);
    const int other = structure.size(n->block);
    if (size == kSplitBlockSize && other == kSplitBlockSize) {
      if (n->transposed) {
        AddTransposedNodeProduct(values, factor, y);
      } else {
        AddNodeProduct(values, factor, y);
      }
    } else if (n->transposed) {
      AddTransposedProduct(other, size, values, factor, y);
    } else {
      AddProduct(size, other, values, factor, y);
    }
  }
}

}  // namespace

PrimalMatrix::PrimalMatrix(const BlockStructure& structure)
    : structure_(structure), dual_(structure.num_rows() - structure.num_primal_rows()) {
  const int num_blocks = structure.num_blocks();
  begins_.assign(num_blocks + 1, 0);
  const auto for_each_entry = [&](const auto& visit) {
    for (int column = 0; column < num_blocks; ++column) {
      for (int e = structure.column_begin(column); e < structure.column_begin(column + 1); ++e) {
        visit(structure.entry_row(e), column, e);
      }
    }
  };
  for_each_entry([&](int row, int column, int /*entry*/) {
    ++begins_[row + 1];
    if (row != column) ++begins_[column + 1];
  });
  for (int b = 0; b < num_blocks; ++b) begins_[b + 1] += begins_[b];
  neighbors_.resize(begins_.back());
  // Column after column, each row meets its neighbours below the diagonal in ascending order, then
  // itself, then, in its own column, the rest.
  std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
  for_each_entry([&](int row, int column, int entry) {
    neighbors_[next[row]++] = {column, entry, false};
    if (row != column) neighbors_[next[column]++] = {row, entry, true};
  });
}

void PrimalMatrix::SetValues(const double* values, const Eigen::VectorXd& diagonal) {
  values_ = values;
  diagonal_ = diagonal.data();
}

void PrimalMatrix::Multiply(const Eigen::VectorXd& x, int num_threads, Eigen::VectorXd* y) const {
  y->resize(num_rows());
  ParallelFor(num_threads, structure_.num_dual(), [&](int begin, int end) {
    for (int d = num_blocks() + begin; d < num_blocks() + end; ++d) {
      double* sum = dual_.data() + structure_.row_offset(d) - num_rows();
      std::fill_n(sum, structure_.size(d), 0.0);
      AddRow(*this, d, x.data(), nullptr, sum);
    }
  });
  ParallelFor(num_threads, num_blocks(), [&](int begin, int end) {
    for (int b = begin; b < end; ++b) {
      const int row = structure_.row_offset(b);
      for (int r = row; r < row + structure_.size(b); ++r) (*y)[r] = diagonal_[r] * x[r];
      AddRow(*this, b, x.data(), dual_.data(), y->data() + row);
    }
  });
}

Eigen::MatrixXd PrimalMatrix::DiagonalBlock(int block) const {
  const int size = structure_.size(block);
  Eigen::MatrixXd sum =
      Eigen::Map<const Eigen::MatrixXd>(values(structure_.column_begin(block)), size, size);
  for (const Neighbor* n = end(block); n != begin(block) && structure_.is_dual((n - 1)->block);) {
    --n;
    const Eigen::Map<const Eigen::MatrixXd> J(values(n->entry), structure_.size(n->block), size);
    sum.noalias() += J.transpose() * J;
  }
  for (int r = 0; r < size; ++r) sum(r, r) += diagonal_[structure_.row_offset(block) + r];
  return sum;
}

}  // namespace ceres_ed
