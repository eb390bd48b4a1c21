#include "ceres_ed/solver/block_cholesky.h"

#include <cstddef>
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

// Copies block values into the scalar matrix and adds the diagonal.
void FillValues(const BlockStructure& structure,
                const double* values,
                const Eigen::VectorXd& diagonal,
                SparseMatrix* matrix) {
  double* out = matrix->valuePtr();
  for (int j = 0; j < structure.num_blocks(); ++j) {
    for (int c = 0; c < structure.size(j); ++c) {
      *out = diagonal[structure.row_offset(j) + c];
      for (int e = structure.column_begin(j); e < structure.column_begin(j + 1); ++e) {
        const int rows = structure.size(structure.entry_row(e));
        const double* column = values + structure.value_offset(e) + std::ptrdiff_t{rows} * c;
        const bool on_diagonal = structure.entry_row(e) == j;
        if (on_diagonal) *out += column[c];
        for (int r = on_diagonal ? c + 1 : 0; r < rows; ++r) {
          out[on_diagonal ? r - c : r] = column[r];
        }
        out += on_diagonal ? rows - c : rows;
      }
    }
  }
}

}  // namespace

#ifdef CERES_ED_HAVE_CHOLMOD

struct BlockCholesky::Impl {
  explicit Impl(const BlockStructure& block_structure)
      : structure(block_structure), matrix(ScalarPattern(block_structure)) {
    cholmod_start(&common);
    common.print = 0;
    common.error_handler = nullptr;
    common.supernodal = CHOLMOD_SUPERNODAL;
    std::vector<int> permutation = Ordering();
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    cholmod_sparse view = View(&matrix);
    factor = cholmod_analyze_p(&view, permutation.data(), nullptr, 0, &common);
    CHECK(factor != nullptr) << "CHOLMOD status " << common.status;
  }

  ~Impl() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }

  static cholmod_sparse View(SparseMatrix* matrix) {
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

  // A fill-reducing order of the blocks, each taken as one row, spelled out for scalar rows.
  std::vector<int> Ordering() {
    SparseMatrix graph(structure.num_blocks(), structure.num_blocks());
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < structure.num_blocks(); ++j) {
      for (int e = structure.column_begin(j); e < structure.column_begin(j + 1); ++e) {
        entries.emplace_back(structure.entry_row(e), j, 1.0);
      }
    }
    graph.setFromTriplets(entries.begin(), entries.end());
    cholmod_sparse view = View(&graph);
    cholmod_factor* symbolic = cholmod_analyze(&view, &common);
    CHECK(symbolic != nullptr) << "CHOLMOD status " << common.status;
    const int* order = static_cast<const int*>(symbolic->Perm);
    std::vector<int> permutation;
    permutation.reserve(structure.num_rows());
    for (int k = 0; k < structure.num_blocks(); ++k) {
      for (int r = 0; r < structure.size(order[k]); ++r) {
        permutation.push_back(structure.row_offset(order[k]) + r);
      }
    }
    cholmod_free_factor(&symbolic, &common);
    return permutation;
  }

  bool Factorize() {
    cholmod_sparse view = View(&matrix);
    return cholmod_factorize(&view, factor, &common) != 0 && common.status == CHOLMOD_OK;
  }

  Eigen::VectorXd Solve(const Eigen::VectorXd& rhs) {
    cholmod_dense b{};
    b.nrow = rhs.size();
    b.ncol = 1;
    b.nzmax = rhs.size();
    b.d = rhs.size();
    b.x = const_cast<double*>(rhs.data());
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* x = cholmod_solve(CHOLMOD_A, factor, &b, &common);
    CHECK(x != nullptr) << "CHOLMOD status " << common.status;
    Eigen::VectorXd solution =
        Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(x->x), rhs.size());
    cholmod_free_dense(&x, &common);
    return solution;
  }

  const BlockStructure& structure;
  SparseMatrix matrix;
  cholmod_common common;
  cholmod_factor* factor = nullptr;
};

#else

struct BlockCholesky::Impl {
  explicit Impl(const BlockStructure& block_structure)
      : structure(block_structure), matrix(ScalarPattern(block_structure)) {
    factor.analyzePattern(matrix);
  }

  bool Factorize() {
    factor.factorize(matrix);
    return factor.info() == Eigen::Success;
  }

  Eigen::VectorXd Solve(const Eigen::VectorXd& rhs) { return factor.solve(rhs); }

  const BlockStructure& structure;
  SparseMatrix matrix;
  Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower> factor;
};

#endif

BlockCholesky::BlockCholesky(const BlockStructure& structure)
    : impl_(std::make_unique<Impl>(structure)) {}

BlockCholesky::~BlockCholesky() = default;

bool BlockCholesky::Factorize(const double* values, const Eigen::VectorXd& diagonal) {
  FillValues(impl_->structure, values, diagonal, &impl_->matrix);
  return impl_->Factorize();
}

Eigen::VectorXd BlockCholesky::Solve(const Eigen::VectorXd& rhs) { return impl_->Solve(rhs); }

}  // namespace ceres_ed
