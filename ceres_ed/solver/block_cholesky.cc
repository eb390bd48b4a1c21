#include "ceres_ed/solver/block_cholesky.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <glog/logging.h>

#ifdef CERES_ED_HAVE_CHOLMOD
#include <cholmod.h>
#endif

namespace ceres_ed {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

// The scalar lower triangle of a block structure.
SparseMatrix ScalarPattern(const BlockStructure& structure) {
  SparseMatrix matrix(structure.num_rows(), structure.num_rows());
  std::vector<int> column_sizes(structure.num_rows());
  for (int j = 0; j < structure.num_blocks(); ++j) {
    for (int c = 0; c < structure.size(j); ++c) {
      int rows = structure.size(j) - c;
      for (int e = structure.column_begin(j) + 1; e < structure.column_begin(j + 1); ++e) {
        rows += structure.size(structure.entry_row(e));
      }
      column_sizes[structure.row_offset(j) + c] = rows;
    }
  }
  matrix.reserve(column_sizes);
  for (int j = 0; j < structure.num_blocks(); ++j) {
    for (int c = 0; c < structure.size(j); ++c) {
      const int column = structure.row_offset(j) + c;
      for (int e = structure.column_begin(j); e < structure.column_begin(j + 1); ++e) {
        const int row_block = structure.entry_row(e);
        for (int r = row_block == j ? c : 0; r < structure.size(row_block); ++r) {
          matrix.insert(structure.row_offset(row_block) + r, column) = 0.0;
        }
      }
    }
  }
  matrix.makeCompressed();
  return matrix;
}

// The same blocks in another order, and where the values of each entry go there.
class OrderedStructure {
 public:
  // `order[k]` is the block that comes k-th.
  OrderedStructure(const BlockStructure& original, const std::vector<int>& order)
      : original_(original), position_(order.size()), ordered_(MakeOrdered(original, order)) {
    for (int k = 0; k < static_cast<int>(order.size()); ++k) position_[order[k]] = k;
    // A value's place in the scalar matrix: where its entry starts in the first column of its block
    // column, and how the columns of that block column follow one another.
    std::ptrdiff_t column_start = 0;
    entry_start_.resize(ordered_.num_entries());
    column_height_.resize(ordered_.num_blocks());
    for (int j = 0; j < ordered_.num_blocks(); ++j) {
      std::ptrdiff_t height = 0;
      for (int e = ordered_.column_begin(j); e < ordered_.column_begin(j + 1); ++e) {
        entry_start_[e] = column_start + height;
        height += ordered_.size(ordered_.entry_row(e));
      }
      column_height_[j] = height;
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

  const BlockStructure& ordered() const { return ordered_; }

  // Copies block values into the scalar lower triangle and adds the diagonal.
  void FillValues(const double* values, const Eigen::VectorXd& diagonal, double* out) const {
    for (int j = 0; j < original_.num_blocks(); ++j) {
      for (int e = original_.column_begin(j); e < original_.column_begin(j + 1); ++e) {
        const int i = original_.entry_row(e);
        const double* block = values + original_.value_offset(e);
        if (i == j) {
          CopyDiagonal(j, entry_of_[e], block, diagonal, out);
        } else {
          CopyBlock(i, j, entry_of_[e], transposed_[e] != 0, block, out);
        }
      }
    }
  }

  // Moves rows between the two orders.
  void ToOrdered(const Eigen::VectorXd& rows, double* ordered_rows) const {
    for (int j = 0; j < original_.num_blocks(); ++j) {
      std::copy_n(rows.data() + original_.row_offset(j),
                  original_.size(j),
                  ordered_rows + ordered_.row_offset(position_[j]));
    }
  }
  void FromOrdered(const double* ordered_rows, Eigen::VectorXd* rows) const {
    rows->resize(original_.num_rows());
    for (int j = 0; j < original_.num_blocks(); ++j) {
      std::copy_n(ordered_rows + ordered_.row_offset(position_[j]),
                  original_.size(j),
                  rows->data() + original_.row_offset(j));
    }
  }

 private:
  static BlockStructure MakeOrdered(const BlockStructure& original, const std::vector<int>& order) {
    std::vector<int> position(order.size());
    std::vector<int> sizes;
    for (int k = 0; k < static_cast<int>(order.size()); ++k) {
      position[order[k]] = k;
      sizes.push_back(original.size(order[k]));
    }
    std::vector<std::pair<int, int>> pairs;
    for (int j = 0; j < original.num_blocks(); ++j) {
      for (int e = original.column_begin(j); e < original.column_begin(j + 1); ++e) {
        pairs.emplace_back(position[original.entry_row(e)], position[j]);
      }
    }
    return BlockStructure(std::move(sizes), pairs);
  }

  // Scalar column c of a block column is c rows shorter than its first: only the lower triangle is
  // stored.
  std::ptrdiff_t ColumnShift(int ordered_column, int c) const {
    return c * column_height_[ordered_column] - c * (c + 1) / 2;
  }

  void CopyDiagonal(int block,
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

  void CopyBlock(int row,
                 int column,
                 int ordered_entry,
                 bool transposed,
                 const double* values,
                 double* out) const {
    const int rows = original_.size(row);
    const int columns = original_.size(column);
    const int ordered_column = transposed ? position_[row] : position_[column];
    double* start = out + entry_start_[ordered_entry];
    for (int c = 0; c < (transposed ? rows : columns); ++c) {
      double* target = start + ColumnShift(ordered_column, c);
      if (transposed) {
        for (int r = 0; r < columns; ++r) target[r] = values[r * rows + c];
      } else {
        std::copy_n(values + c * rows, rows, target);
      }
    }
  }

  const BlockStructure& original_;
  std::vector<int> position_;
  BlockStructure ordered_;
  std::vector<std::ptrdiff_t> entry_start_;
  std::vector<std::ptrdiff_t> column_height_;
  std::vector<int> entry_of_;
  std::vector<char> transposed_;
};

}  // namespace

#ifdef CERES_ED_HAVE_CHOLMOD

namespace {

cholmod_sparse View(SparseMatrix* matrix) {
  cholmod_sparse view{};
  view.nrow = matrix->rows();
  view.ncol = matrix->cols();
  view.nzmax = matrix->nonZeros();
  view.p = matrix->outerIndexPtr();
  view.i = matrix->innerIndexPtr();
  view.x = matrix->valuePtr();
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

// A fill-reducing, postordered order of the blocks, each taken as one row.
std::vector<int> FillReducingOrder(const BlockStructure& structure, cholmod_common* common) {
  SparseMatrix graph(structure.num_blocks(), structure.num_blocks());
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < structure.num_blocks(); ++j) {
    for (int e = structure.column_begin(j); e < structure.column_begin(j + 1); ++e) {
      entries.emplace_back(structure.entry_row(e), j, 1.0);
    }
  }
  graph.setFromTriplets(entries.begin(), entries.end());
  cholmod_sparse view = View(&graph);
  cholmod_factor* symbolic = cholmod_analyze(&view, common);
  CHECK(symbolic != nullptr) << "CHOLMOD status " << common->status;
  const int* order = static_cast<const int*>(symbolic->Perm);
  std::vector<int> blocks(order, order + structure.num_blocks());
  cholmod_free_factor(&symbolic, common);
  return blocks;
}

}  // namespace

struct BlockCholesky::Impl {
  explicit Impl(const BlockStructure& block_structure)
      : started(Start()),
        structure(block_structure, FillReducingOrder(block_structure, &common)),
        matrix(ScalarPattern(structure.ordered())),
        rhs(matrix.rows()) {
    // The matrix is in its final order: CHOLMOD then takes it as it is, without a permuted copy.
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_NATURAL;
    common.postorder = 0;
    cholmod_sparse view = View(&matrix);
    factor = cholmod_analyze(&view, &common);
    CHECK(factor != nullptr) << "CHOLMOD status " << common.status;
  }

  ~Impl() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }

  bool Start() {
    cholmod_start(&common);
    common.print = 0;
    common.error_handler = nullptr;
    return true;
  }

  bool Factorize(const double* values, const Eigen::VectorXd& diagonal) {
    structure.FillValues(values, diagonal, matrix.valuePtr());
    cholmod_sparse view = View(&matrix);
    return cholmod_factorize(&view, factor, &common) != 0 && common.status == CHOLMOD_OK;
  }

  Eigen::VectorXd Solve(const Eigen::VectorXd& right_side) {
    structure.ToOrdered(right_side, rhs.data());
    cholmod_dense b{};
    b.nrow = rhs.size();
    b.ncol = 1;
    b.nzmax = rhs.size();
    b.d = rhs.size();
    b.x = rhs.data();
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* x = cholmod_solve(CHOLMOD_A, factor, &b, &common);
    CHECK(x != nullptr) << "CHOLMOD status " << common.status;
    Eigen::VectorXd solution;
    structure.FromOrdered(static_cast<const double*>(x->x), &solution);
    cholmod_free_dense(&x, &common);
    return solution;
  }

  cholmod_common common;
  bool started;
  OrderedStructure structure;
  SparseMatrix matrix;
  Eigen::VectorXd rhs;
  cholmod_factor* factor = nullptr;
};

#else

struct BlockCholesky::Impl {
  explicit Impl(const BlockStructure& block_structure)
      : structure(block_structure, NaturalOrder(block_structure)),
        matrix(ScalarPattern(structure.ordered())) {
    factor.analyzePattern(matrix);
  }

  static std::vector<int> NaturalOrder(const BlockStructure& block_structure) {
    std::vector<int> order(block_structure.num_blocks());
    std::iota(order.begin(), order.end(), 0);
    return order;
  }

  bool Factorize(const double* values, const Eigen::VectorXd& diagonal) {
    structure.FillValues(values, diagonal, matrix.valuePtr());
    factor.factorize(matrix);
    return factor.info() == Eigen::Success;
  }

  Eigen::VectorXd Solve(const Eigen::VectorXd& right_side) { return factor.solve(right_side); }

  OrderedStructure structure;
  SparseMatrix matrix;
  Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower> factor;
};

#endif

BlockCholesky::BlockCholesky(const BlockStructure& structure)
    : impl_(std::make_unique<Impl>(structure)) {}

BlockCholesky::~BlockCholesky() = default;

bool BlockCholesky::Factorize(const double* values, const Eigen::VectorXd& diagonal) {
  return impl_->Factorize(values, diagonal);
}

Eigen::VectorXd BlockCholesky::Solve(const Eigen::VectorXd& rhs) { return impl_->Solve(rhs); }

}  // namespace ceres_ed
