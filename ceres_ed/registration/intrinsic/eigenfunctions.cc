#include "ceres_ed/registration/intrinsic/eigenfunctions.h"

#include <ceres_ed/linear_algebra/sparse_cholesky.h>

#include <algorithm>
#include <exception>

#include <Spectra/SymEigsShiftSolver.h>

namespace ceres_ed {
namespace {

// The eigenvalues nearest to this are found; those of a surface of area 1 begin at 0, 5 or more.
constexpr double kShift = -0.5;
constexpr double kTolerance = 1e-9;
constexpr int kMaxRestarts = 200;

// The operator y = (A - shift)^-1 x for Spectra, where A = M^-1/2 L M^-1/2 is symmetric.
class ShiftedInverse {
 public:
  using Scalar = double;

  explicit ShiftedInverse(const Eigen::SparseMatrix<double>& lower)
      : lower_(lower), factor_(lower) {}

  Eigen::Index rows() const { return lower_.rows(); }
  Eigen::Index cols() const { return lower_.cols(); }
  void set_shift(double shift) {
    Eigen::SparseMatrix<double> shifted = lower_;
    for (Eigen::Index i = 0; i < shifted.cols(); ++i) shifted.coeffRef(i, i) -= shift;
    is_positive_ = factor_.Factorize(shifted);
  }
  void perform_op(const double* x, double* y) const {
    const Eigen::Index n = rows();
    Eigen::Map<Eigen::VectorXd>(y, n) = factor_.Solve(Eigen::Map<const Eigen::VectorXd>(x, n));
  }
  bool is_positive() const { return is_positive_; }

 private:
  const Eigen::SparseMatrix<double>& lower_;
  mutable SparseCholesky factor_;
  bool is_positive_ = false;
};

// Finds the `count` smallest eigenvalues of a symmetric, positive semidefinite matrix, which is
// given by its lower triangle, and their eigenvectors. Returns whether they were found.
bool FindEigenvectors(const Eigen::SparseMatrix<double>& lower,
                      int count,
                      Eigen::VectorXd* values,
                      Eigen::MatrixXd* vectors) {
  const int n = static_cast<int>(lower.cols());
  // Any fixed vector that is perpendicular to no eigenvector will do.
  Eigen::VectorXd start(n);
  for (int i = 0; i < n; ++i) start[i] = 1.0 + 0.3 * ((i % 1009) * 7919 % 1009) / 1009.0;
  try {
    ShiftedInverse inverse(lower);
    const int subspace = std::min(n, std::max(2 * count, count + 20));
    Spectra::SymEigsShiftSolver<ShiftedInverse> solver(inverse, count, subspace, kShift);
    if (!inverse.is_positive()) return false;
    solver.init(start.data());
    solver.compute(
        Spectra::SortRule::LargestMagn, kMaxRestarts, kTolerance, Spectra::SortRule::SmallestAlge);
    if (solver.info() != Spectra::CompInfo::Successful) return false;
    *values = solver.eigenvalues();
    *vectors = solver.eigenvectors();
    return true;
  } catch (const std::exception&) {
    // Spectra throws if the small dense problem within it does not converge.
    return false;
  }
}

}  // namespace

std::optional<SpectralBasis> ComputeEigenfunctions(const Laplacian& laplacian, int count) {
  const int n = static_cast<int>(laplacian.mass.size());
  count = std::min(count, n / 3);
  const double area = laplacian.mass.sum();
  if (count < 2 || !(area > 0.0)) return std::nullopt;
  SpectralBasis basis;
  basis.mass = laplacian.mass / area;
  const Eigen::VectorXd scale = basis.mass.cwiseSqrt().cwiseInverse();
  Eigen::SparseMatrix<double> symmetric = laplacian.stiffness;
  for (int column = 0; column < n; ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(symmetric, column); entry; ++entry) {
      entry.valueRef() *= scale[entry.row()] * scale[column];
    }
  }
  if (!FindEigenvectors(symmetric, count, &basis.eigenvalues, &basis.functions)) {
    return std::nullopt;
  }
  basis.functions = scale.asDiagonal() * basis.functions;
  if (!basis.eigenvalues.allFinite() || !basis.functions.allFinite()) return std::nullopt;
  if (basis.functions.col(0).sum() < 0.0) basis.functions.col(0) *= -1.0;
  return basis;
}

}  // namespace ceres_ed
