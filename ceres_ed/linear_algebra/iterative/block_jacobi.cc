#include "ceres_ed/linear_algebra/iterative/block_jacobi.h"

#include <ceres_ed/util/parallel.h>

#include <atomic>

#include <Eigen/Cholesky>

namespace ceres_ed {
namespace {

// Sets the inverse of a symmetric positive definite matrix; returns false if it has none.
template <typename Inverse>
bool Invert(const Eigen::MatrixXd& matrix, Inverse* inverse) {
  const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
  if (factor.info() != Eigen::Success) return false;
  *inverse = factor.solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols()));
  return true;
}

}  // namespace

BlockJacobi::BlockJacobi(const PrimalMatrix& matrix)
    : matrix_(matrix), num_blocks_(matrix.num_blocks()) {
  const BlockStructure& structure = matrix.structure();
  if (num_blocks_ > 1 && structure.size(num_blocks_ - 1) < structure.size(0)) {
    border_ = --num_blocks_;
  }
  places_.push_back(0);
  for (int b = 0; b < num_blocks_; ++b) {
    places_.push_back(places_.back() +
                      static_cast<std::size_t>(structure.size(b)) * structure.size(b));
  }
  inverses_.resize(places_.back());
}

bool BlockJacobi::Update(int num_threads) {
  std::atomic<bool> definite{true};
  ParallelFor(num_threads, num_blocks_, [&](int begin, int end) {
    for (int b = begin; b < end; ++b) {
      const int size = matrix_.structure().size(b);
      Eigen::Map<Eigen::MatrixXd> inverse(&inverses_[places_[b]], size, size);
      if (!Invert(matrix_.DiagonalBlock(b), &inverse)) definite = false;
    }
  });
  if (!definite) return false;
  if (border_ < 0) return true;
  UpdateBorder();
  return has_border_ || Invert(matrix_.DiagonalBlock(border_), &border_inverse_);
}

void BlockJacobi::UpdateBorder() {
  const BlockStructure& structure = matrix_.structure();
  Eigen::MatrixXd schur = matrix_.DiagonalBlock(border_);
  for (const PrimalMatrix::Neighbor* n = matrix_.begin(border_); n->block != border_; ++n) {
    const int size = structure.size(n->block);
    const Eigen::Map<const Eigen::MatrixXd> C(matrix_.values(n->entry), schur.rows(), size);
    const Eigen::Map<const Eigen::MatrixXd> inverse(&inverses_[places_[n->block]], size, size);
    schur.noalias() -= C * inverse * C.transpose();
  }
  has_border_ = Invert(schur, &border_inverse_);
}

void BlockJacobi::Apply(const Eigen::VectorXd& x, int num_threads, Eigen::VectorXd* y) {
  const BlockStructure& structure = matrix_.structure();
  y->resize(x.size());
  const auto solve = [&](int b) {
    const int row = structure.row_offset(b);
    const int size = structure.size(b);
    const Eigen::Map<const Eigen::MatrixXd> inverse(&inverses_[places_[b]], size, size);
    y->segment(row, size).noalias() = inverse * x.segment(row, size);
  };
  ParallelFor(num_threads, num_blocks_, [&](int begin, int end) {
    for (int b = begin; b < end; ++b) solve(b);
  });
  if (border_ < 0) return;
  const int row = structure.row_offset(border_);
  const auto size = static_cast<int>(border_inverse_.rows());
  Eigen::VectorXd right = x.segment(row, size);
  const auto for_each_border = [&](const auto& visit) {
    for (const PrimalMatrix::Neighbor* n = matrix_.begin(border_); n->block != border_; ++n) {
      const int columns = structure.size(n->block);
      visit(n->block,
            Eigen::Map<const Eigen::MatrixXd>(matrix_.values(n->entry), size, columns),
            structure.row_offset(n->block),
            columns);
    }
  };
  if (has_border_) {
    for_each_border([&](int /*block*/, const auto& C, int first, int columns) {
      right.noalias() -= C * y->segment(first, columns);
    });
  }
  const Eigen::VectorXd solution = border_inverse_ * right;
  y->segment(row, size) = solution;
  if (!has_border_) return;
  for_each_border([&](int block, const auto& C, int first, int columns) {
    const Eigen::Map<const Eigen::MatrixXd> inverse(&inverses_[places_[block]], columns, columns);
    y->segment(first, columns).noalias() -= inverse * (C.transpose() * solution);
  });
}

}  // namespace ceres_ed
