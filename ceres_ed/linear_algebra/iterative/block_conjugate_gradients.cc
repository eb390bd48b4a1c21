#include "ceres_ed/linear_algebra/iterative/block_conjugate_gradients.h"

#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ceres_ed {
namespace {

// How many iterations pass between two questions whether to stop.
constexpr int kStopInterval = 32;

// Loops over vectors, in pieces that do not depend on the number of threads.
class Vectors {
 public:
  Vectors(int size, int num_threads)
      : size_(size), num_threads_(num_threads), sums_((size + kPiece - 1) / kPiece) {}

  // Runs body(first, count) on all pieces.
  template <typename Body>
  void ForEachPiece(const Body& body) {
    ParallelFor(num_threads_, static_cast<int>(sums_.size()), [&](int begin, int end) {
      for (int piece = begin; piece < end; ++piece) {
        const int first = piece * kPiece;
        sums_[piece] = body(first, std::min(kPiece, size_ - first));
      }
    });
  }

  // Returns the sum of what body(first, count) returns for the pieces.
  template <typename Body>
  double Sum(const Body& body) {
    ForEachPiece(body);
    double sum = 0.0;
    for (const double piece : sums_) sum += piece;
    return sum;
  }

  double Dot(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return Sum(
        [&](int first, int count) { return a.segment(first, count).dot(b.segment(first, count)); });
  }

 private:
  static constexpr int kPiece = 12 * 512;

  const int size_;
  const int num_threads_;
  std::vector<double> sums_;
};

}  // namespace

BlockGradientSummary SolveByBlockGradients(const PrimalMatrix& A,
                                           const Eigen::VectorXd& b,
                                           const BlockGradientOptions& options,
                                           Preconditioner* M,
                                           Eigen::VectorXd* x) {
  const int size = A.num_rows();
  const int num_threads = options.num_threads;
  Vectors vectors(size, num_threads);
  BlockGradientSummary summary;
  x->setZero(size);
  Eigen::VectorXd residual = b.head(size);
  Eigen::VectorXd preconditioned(size);
  Eigen::VectorXd product(size);
  M->Apply(residual, num_threads, &preconditioned);
  Eigen::VectorXd direction = preconditioned;
  double energy = vectors.Dot(residual, preconditioned);
  const double start = energy;
  const double goal = options.tolerance * options.tolerance * start;
  while (energy > goal && summary.iterations < options.max_iterations) {
    ++summary.iterations;
    if (summary.iterations % kStopInterval == 0 && options.should_stop && options.should_stop()) {
      break;
    }
    A.Multiply(direction, num_threads, &product);
    const double curvature = vectors.Dot(direction, product);
    if (!(curvature > 0.0) || !std::isfinite(curvature)) {
      summary.failed = true;
      return summary;
    }
    const double step = energy / curvature;
    vectors.ForEachPiece([&](int first, int count) {
      x->segment(first, count) += step * direction.segment(first, count);
      residual.segment(first, count) -= step * product.segment(first, count);
      return 0.0;
    });
    M->Apply(residual, num_threads, &preconditioned);
    const double next = vectors.Dot(residual, preconditioned);
    const double ratio = next / energy;
    vectors.ForEachPiece([&](int first, int count) {
      direction.segment(first, count) =
          preconditioned.segment(first, count) + ratio * direction.segment(first, count);
      return 0.0;
    });
    energy = next;
  }
  summary.failed = !std::isfinite(energy) || energy < 0.0;
  summary.relative_residual = start > 0.0 ? std::sqrt(std::max(0.0, energy) / start) : 0.0;
  return summary;
}

}  // namespace ceres_ed
