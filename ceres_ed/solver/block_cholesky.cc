#include "ceres_ed/solver/block_cholesky.h"

#include <ceres_ed/solver/ordered_structure.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/OrderingMethods>
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

// The block graph of the first `num_blocks` blocks, lower triangle.
SparseMatrix LeadingGraph(const BlockStructure& structure, int num_blocks) {
  CHECK(num_blocks >= 0 && num_blocks <= structure.num_blocks()) << num_blocks << " blocks";
  SparseMatrix graph(num_blocks, num_blocks);
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < num_blocks; ++j) {
    for (int e = structure.column_begin(j); e < structure.column_begin(j + 1); ++e) {
      if (structure.entry_row(e) < num_blocks) entries.emplace_back(structure.entry_row(e), j, 1.0);
    }
  }
  graph.setFromTriplets(entries.begin(), entries.end());
  return graph;
}

void AppendTrailing(const BlockStructure& structure, std::vector<int>* order) {
  for (int j = static_cast<int>(order->size()); j < structure.num_blocks(); ++j) {
    order->push_back(j);
  }
}

// Scalar rows of the last blocks.
int NumTrailingRows(const BlockStructure& structure, int num_trailing) {
  return structure.num_rows() - structure.row_offset(structure.num_blocks() - num_trailing);
}

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

// A fill-reducing, postordered order of the blocks, each taken as one row, with the trailing ones
// behind the others.
std::vector<int> FillReducingOrder(const BlockStructure& structure,
                                   int num_trailing,
                                   cholmod_common* common) {
  SparseMatrix graph = LeadingGraph(structure, structure.num_blocks() - num_trailing);
  std::vector<int> blocks;
  if (graph.cols() > 0) {
    cholmod_sparse view = View(&graph);
    cholmod_factor* symbolic = cholmod_analyze(&view, common);
    CHECK(symbolic != nullptr) << "CHOLMOD status " << common->status;
    const int* order = static_cast<const int*>(symbolic->Perm);
    blocks.assign(order, order + graph.cols());
    cholmod_free_factor(&symbolic, common);
  }
  AppendTrailing(structure, &blocks);
  return blocks;
}

}  // namespace

struct BlockCholesky::Impl {
  Impl(const BlockStructure& block_structure, int num_trailing)
      : started(Start()),
        structure(block_structure, FillReducingOrder(block_structure, num_trailing, &common)),
        matrix(ScalarPattern(structure.ordered())),
        num_trailing_rows(NumTrailingRows(block_structure, num_trailing)),
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

  Eigen::VectorXd Solve(const Eigen::VectorXd& right_side) { return Solve(CHOLMOD_A, right_side); }
  Eigen::VectorXd SolveLower(const Eigen::VectorXd& right_side) {
    return Solve(CHOLMOD_L, right_side);
  }
  Eigen::VectorXd SolveUpper(const Eigen::VectorXd& right_side) {
    return Solve(CHOLMOD_Lt, right_side);
  }

  // Supernodes are dense columns of rows that they share: rows s[pi[k]...] and values from px[k].
  Eigen::MatrixXd TrailingFactor() const {
    const int first = static_cast<int>(factor->n) - num_trailing_rows;
    Eigen::MatrixXd trailing = Eigen::MatrixXd::Zero(num_trailing_rows, num_trailing_rows);
    const int* super = static_cast<const int*>(factor->super);
    const int* pi = static_cast<const int*>(factor->pi);
    const int* px = static_cast<const int*>(factor->px);
    const int* rows = static_cast<const int*>(factor->s);
    const double* values = static_cast<const double*>(factor->x);
    for (int k = static_cast<int>(factor->nsuper) - 1; k >= 0 && super[k + 1] > first; --k) {
      const int num_rows = pi[k + 1] - pi[k];
      for (int j = std::max(first, super[k]); j < super[k + 1]; ++j) {
        const double* column =
            values + px[k] + static_cast<std::ptrdiff_t>(j - super[k]) * num_rows;
        for (int i = j - super[k]; i < num_rows; ++i) {
          trailing(rows[pi[k] + i] - first, j - first) = column[i];
        }
      }
    }
    return trailing;
  }

  Eigen::VectorXd Solve(int system, const Eigen::VectorXd& right_side) {
    structure.ToOrdered(right_side, rhs.data());
    cholmod_dense b{};
    b.nrow = rhs.size();
    b.ncol = 1;
    b.nzmax = rhs.size();
    b.d = rhs.size();
    b.x = rhs.data();
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* x = cholmod_solve(system, factor, &b, &common);
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
  int num_trailing_rows;
  Eigen::VectorXd rhs;
  cholmod_factor* factor = nullptr;
};

#else

struct BlockCholesky::Impl {
  Impl(const BlockStructure& block_structure, int num_trailing)
      : structure(block_structure, FillReducingOrder(block_structure, num_trailing)),
        matrix(ScalarPattern(structure.ordered())),
        num_trailing_rows(NumTrailingRows(block_structure, num_trailing)),
        rhs(matrix.rows()) {
    factor.analyzePattern(matrix);
  }

  // The trailing blocks behind the others.
  static std::vector<int> FillReducingOrder(const BlockStructure& block_structure,
                                            int num_trailing) {
    const SparseMatrix graph =
        LeadingGraph(block_structure, block_structure.num_blocks() - num_trailing);
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order(graph.cols());
    if (graph.cols() > 0) Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Lower>(), order);
    std::vector<int> blocks(order.indices().data(), order.indices().data() + graph.cols());
    AppendTrailing(block_structure, &blocks);
    return blocks;
  }

  bool Factorize(const double* values, const Eigen::VectorXd& diagonal) {
    structure.FillValues(values, diagonal, matrix.valuePtr());
    factor.factorize(matrix);
    return factor.info() == Eigen::Success;
  }

  Eigen::VectorXd Solve(const Eigen::VectorXd& right_side) {
    structure.ToOrdered(right_side, rhs.data());
    return FromOrdered(factor.solve(rhs));
  }
  Eigen::VectorXd SolveLower(const Eigen::VectorXd& right_side) {
    structure.ToOrdered(right_side, rhs.data());
    return FromOrdered(factor.matrixL().solve(rhs));
  }
  Eigen::VectorXd SolveUpper(const Eigen::VectorXd& right_side) {
    structure.ToOrdered(right_side, rhs.data());
    return FromOrdered(factor.matrixU().solve(rhs));
  }

  Eigen::VectorXd FromOrdered(const Eigen::VectorXd& ordered) const {
    Eigen::VectorXd rows;
    structure.FromOrdered(ordered.data(), &rows);
    return rows;
  }

  Eigen::MatrixXd TrailingFactor() const {
    const SparseMatrix L = factor.matrixL();
    return Eigen::MatrixXd(L.bottomRightCorner(num_trailing_rows, num_trailing_rows));
  }

  OrderedStructure structure;
  SparseMatrix matrix;
  int num_trailing_rows;
  Eigen::VectorXd rhs;
  // The matrix is in its final order.
  Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> factor;
};

#endif

BlockCholesky::BlockCholesky(const BlockStructure& structure, int num_trailing)
    : impl_(std::make_unique<Impl>(structure, num_trailing)) {}

BlockCholesky::~BlockCholesky() = default;

bool BlockCholesky::Factorize(const double* values, const Eigen::VectorXd& diagonal) {
  return impl_->Factorize(values, diagonal);
}

Eigen::VectorXd BlockCholesky::Solve(const Eigen::VectorXd& rhs) { return impl_->Solve(rhs); }

Eigen::VectorXd BlockCholesky::SolveLower(const Eigen::VectorXd& rhs) {
  return impl_->SolveLower(rhs);
}

Eigen::VectorXd BlockCholesky::SolveUpper(const Eigen::VectorXd& rhs) {
  return impl_->SolveUpper(rhs);
}

Eigen::MatrixXd BlockCholesky::TrailingFactor() const { return impl_->TrailingFactor(); }

}  // namespace ceres_ed
