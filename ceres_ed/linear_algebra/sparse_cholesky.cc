#include "ceres_ed/linear_algebra/sparse_cholesky.h"

#include <ceres_ed/linear_algebra/block_cholesky.h>
#include <ceres_ed/linear_algebra/block_structure.h>

#include <vector>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// Returns a structure with blocks of one row; their values have the same order as those of the
// compressed lower triangle.
BlockStructure StructureOf(const SparseCholesky::Matrix& lower) {
  CHECK(lower.isCompressed());
  const int n = static_cast<int>(lower.cols());
  std::vector<BlockPair> pairs;
  pairs.reserve(lower.nonZeros());
  for (int column = 0; column < n; ++column) {
    const int first = lower.outerIndexPtr()[column];
    const int last = lower.outerIndexPtr()[column + 1];
    CHECK(first < last && lower.innerIndexPtr()[first] == column) << "no diagonal: " << column;
    for (int k = first + 1; k < last; ++k) pairs.push_back({lower.innerIndexPtr()[k], column});
  }
  return BlockStructure(std::vector<int>(n, 1), pairs);
}

}  // namespace

struct SparseCholesky::Impl {
  Impl(const Matrix& lower, const std::function<bool()>& should_stop)
      : structure(StructureOf(lower)),
        factor(structure, 0, nullptr, should_stop),
        no_more(Eigen::VectorXd::Zero(structure.num_rows())) {}

  const BlockStructure structure;
  BlockCholesky factor;
  // Nothing (zeros) is added to the diagonal.
  const Eigen::VectorXd no_more;
};

SparseCholesky::SparseCholesky(const Matrix& lower, const std::function<bool()>& should_stop)
    : impl_(std::make_unique<Impl>(lower, should_stop)) {}

SparseCholesky::~SparseCholesky() = default;

bool SparseCholesky::Factorize(const Matrix& lower, const std::function<bool()>& should_stop) {
  CHECK_EQ(static_cast<int>(lower.nonZeros()), impl_->structure.num_entries());
  return impl_->factor.Factorize(lower.valuePtr(), impl_->no_more, 1, should_stop);
}

Eigen::MatrixXd SparseCholesky::Solve(const Eigen::MatrixXd& rhs) {
  Eigen::MatrixXd solution(rhs.rows(), rhs.cols());
  for (Eigen::Index c = 0; c < rhs.cols(); ++c) solution.col(c) = impl_->factor.Solve(rhs.col(c));
  return solution;
}

}  // namespace ceres_ed
