#include "ceres_ed/solver/sparse_cholesky.h"

#include <Eigen/SparseCholesky>
#include <glog/logging.h>

#ifdef CERES_ED_HAVE_CHOLMOD
#include <cholmod.h>
#endif

namespace ceres_ed {

#ifdef CERES_ED_HAVE_CHOLMOD

namespace {

// CHOLMOD's names for what it only reads aren't const.
cholmod_sparse View(const SparseCholesky::Matrix& matrix) {
  cholmod_sparse view{};
  view.nrow = matrix.rows();
  view.ncol = matrix.cols();
  view.nzmax = matrix.nonZeros();
  view.p = const_cast<int*>(matrix.outerIndexPtr());
  view.i = const_cast<int*>(matrix.innerIndexPtr());
  view.x = const_cast<double*>(matrix.valuePtr());
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

}  // namespace

struct SparseCholesky::Impl {
  explicit Impl(const Matrix& lower) {
    CHECK(lower.isCompressed());
    cholmod_start(&common);
    common.print = 0;
    common.error_handler = nullptr;
    common.supernodal = CHOLMOD_SUPERNODAL;
    // Trying more orders than one costs more than they save.
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_AMD;
    cholmod_sparse view = View(lower);
    factor = cholmod_analyze(&view, &common);
    CHECK(factor != nullptr) << "CHOLMOD status " << common.status;
  }

  ~Impl() {
    cholmod_free_dense(&x, &common);
    cholmod_free_dense(&y, &common);
    cholmod_free_dense(&e, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }

  bool Factorize(const Matrix& lower) {
    cholmod_sparse view = View(lower);
    return cholmod_factorize(&view, factor, &common) != 0 && common.status == CHOLMOD_OK;
  }

  Eigen::MatrixXd Solve(const Eigen::MatrixXd& rhs) {
    cholmod_dense b{};
    b.nrow = rhs.rows();
    b.ncol = rhs.cols();
    b.nzmax = rhs.size();
    b.d = rhs.rows();
    b.x = const_cast<double*>(rhs.data());
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    const int solved = cholmod_solve2(CHOLMOD_A, factor, &b, nullptr, &x, nullptr, &y, &e, &common);
    CHECK(solved != 0) << "CHOLMOD status " << common.status;
    return Eigen::Map<const Eigen::MatrixXd>(
        static_cast<const double*>(x->x), rhs.rows(), rhs.cols());
  }

  cholmod_common common;
  cholmod_factor* factor = nullptr;
  // The solution and two work spaces that cholmod_solve2 uses again.
  cholmod_dense* x = nullptr;
  cholmod_dense* y = nullptr;
  cholmod_dense* e = nullptr;
};

#else

struct SparseCholesky::Impl {
  explicit Impl(const Matrix& lower) { factor.analyzePattern(lower); }

  bool Factorize(const Matrix& lower) {
    factor.factorize(lower);
    return factor.info() == Eigen::Success;
  }

  Eigen::MatrixXd Solve(const Eigen::MatrixXd& rhs) { return factor.solve(rhs); }

  Eigen::SimplicialLLT<Matrix, Eigen::Lower> factor;
};

#endif

SparseCholesky::SparseCholesky(const Matrix& lower) : impl_(std::make_unique<Impl>(lower)) {}

SparseCholesky::~SparseCholesky() = default;

bool SparseCholesky::Factorize(const Matrix& lower) { return impl_->Factorize(lower); }

Eigen::MatrixXd SparseCholesky::Solve(const Eigen::MatrixXd& rhs) { return impl_->Solve(rhs); }

}  // namespace ceres_ed
