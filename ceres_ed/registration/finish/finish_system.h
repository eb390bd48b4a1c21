// The linear system of a finish: one matrix for x, y and z.
#ifndef CERES_ED_REGISTRATION_FINISH_FINISH_SYSTEM_H_
#define CERES_ED_REGISTRATION_FINISH_FINISH_SYSTEM_H_

#include <ceres_ed/linear_algebra/sparse_cholesky.h>

#include <functional>
#include <memory>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace ceres_ed {

// The matrix lambda B + diag(w), where the positive weights w change from round to round. Meshes of
// usual size have a Cholesky factor, which serves all steps of a round. A factor of a million
// vertices would take gigabytes, and ordering it seconds that cannot be interrupted; such meshes
// are solved by conjugate gradients, which converge in some dozen iterations where most vertices
// are matched.
class FinishSystem {
 public:
  // At most this many vertices are solved with a factor.
  static constexpr int kMaxFactorVertices = 150000;

  // `smoothness` is lambda B (its lower triangle, see SparseCholesky), which must outlive this
  // object. `should_stop` is called often; if it returns true, the functions below return false.
  FinishSystem(const SparseCholesky::Matrix& smoothness, std::function<bool()> should_stop);

  // Sets w. Returns false if it was stopped.
  bool SetWeights(const Eigen::VectorXd& weights);

  // Solves for the three columns of `rhs`. Returns false if it was stopped.
  bool Solve(const Eigen::MatrixXd& rhs, Eigen::MatrixXd* solution);

 private:
  const SparseCholesky::Matrix& smoothness_;
  const std::function<bool()> should_stop_;
  // With a factor: the lower triangle. Otherwise all entries.
  SparseCholesky::Matrix lower_;
  std::unique_ptr<SparseCholesky> factor_;
  Eigen::SparseMatrix<double, Eigen::RowMajor, int> full_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_FINISH_FINISH_SYSTEM_H_
