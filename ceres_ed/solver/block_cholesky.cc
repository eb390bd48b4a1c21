#include "ceres_ed/solver/block_cholesky.h"

#include <ceres_ed/solver/ordered_structure.h>

#include <numeric>
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
