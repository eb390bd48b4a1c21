// An incomplete factor of a matrix as its preconditioner.
#ifndef CERES_ED_LINEAR_ALGEBRA_ITERATIVE_INCOMPLETE_CHOLESKY_H_
#define CERES_ED_LINEAR_ALGEBRA_ITERATIVE_INCOMPLETE_CHOLESKY_H_

#include <ceres_ed/linear_algebra/iterative/preconditioner.h>

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// M = L L^T, where L has blocks only where A has them (Meijerink and van der Vorst 1977, by
// blocks). Of J^T J only the diagonal blocks are taken. If the factor breaks down, the diagonal is
// increased until there is one (Manteuffel 1980). Uses one thread, since each block waits for
// others. Takes as much memory as the matrix.
class IncompleteCholesky final : public Preconditioner {
 public:
  // `matrix` must outlive this object.
  explicit IncompleteCholesky(const PrimalMatrix& matrix);

  bool Update(int num_threads) override;
  void Apply(const Eigen::VectorXd& x, int num_threads, Eigen::VectorXd* y) override;

 private:
  using Block = Eigen::Map<Eigen::MatrixXd>;

  // Takes the numbers of the matrix, with its diagonal multiplied by `scale`.
  void Take(double scale);
  // Makes the factor of them; returns false if a pivot is not positive definite.
  bool Factorize();
  void SubtractProducts(int column);
  // Returns a block of L; its diagonal blocks are lower triangular.
  Block At(int entry, int column);
  // Returns the end of the primal entries of a column.
  int End(int column) const { return ends_[column]; }

  const PrimalMatrix& matrix_;
  std::vector<int> ends_;
  std::vector<std::size_t> places_;
  std::vector<double> values_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_ITERATIVE_INCOMPLETE_CHOLESKY_H_
