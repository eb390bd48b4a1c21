#include "ceres_ed/linear_algebra/iterative/two_level_preconditioner.h"

#include <ceres_ed/util/for_each_machine.h>
#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <utility>

namespace ceres_ed {
namespace {

constexpr int kNode = TwoLevelPreconditioner::kNode;
// The diagonal of the coarse matrix is increased by this part, so that coarse nodes whose fields
// nearly coincide do not make it singular.
constexpr double kCoarseShift = 1e-10;

using NodeBlock = TwoLevelPreconditioner::NodeBlock;

// Sets X = B T, where T is the part of Z that takes a coarse node to a fine one:
// T = weight [I 0; lever^T (x) I_3, I_3].
void MultiplyFromTheRight(const AffineProlongation::Part& part, const NodeBlock& B, NodeBlock* X) {
  *X = part.weight * B;
  for (int axis = 0; axis < 3; ++axis) {
    X->middleCols<3>(3 * axis) += (part.weight * part.lever[axis]) * B.middleCols<3>(9);
  }
}

// Adds T^T X to `sum`.
template <typename Sum>
void AddFromTheLeft(const AffineProlongation::Part& part, const NodeBlock& X, Sum* sum) {
  *sum += part.weight * X;
  for (int axis = 0; axis < 3; ++axis) {
    sum->template middleRows<3>(3 * axis) += (part.weight * part.lever[axis]) * X.middleRows<3>(9);
  }
}

}  // namespace

// The rows J Z of a dual block, by coarse blocks.
struct TwoLevelPreconditioner::DualRows {
  int count = 0;
  std::vector<int> coarse;
  std::vector<NodeBlock> blocks;

  void Add(int index, const NodeBlock& block) {
    const auto found = std::find(coarse.begin(), coarse.begin() + count, index);
    if (found != coarse.begin() + count) {
      blocks[found - coarse.begin()] += block;
      return;
    }
    if (count == static_cast<int>(coarse.size())) {
      coarse.emplace_back();
      blocks.emplace_back();
    }
    coarse[count] = index;
    blocks[count++] = block;
  }

  const NodeBlock& Of(int index) const {
    return blocks[std::find(coarse.begin(), coarse.begin() + count, index) - coarse.begin()];
  }
};

TwoLevelPreconditioner::TwoLevelPreconditioner(const PrimalMatrix& matrix,
                                               AffineProlongation prolongation)
    : matrix_(matrix),
      num_nodes_(prolongation.num_fine()),
      Z_(std::move(prolongation)),
      jacobi_(matrix) {
  AddOtherBlocks();
  column_begins_.assign(Z_.num_coarse + 1, 0);
  for (const Part& part : Z_.parts) ++column_begins_[part.coarse + 1];
  for (int c = 0; c < Z_.num_coarse; ++c) column_begins_[c + 1] += column_begins_[c];
  column_parts_.resize(Z_.parts.size());
  std::vector<int> next(column_begins_.begin(), column_begins_.end() - 1);
  for (int fine = 0; fine < Z_.num_fine(); ++fine) {
    for (int p = Z_.begins[fine]; p < Z_.begins[fine + 1]; ++p) {
      column_parts_[next[Z_.parts[p].coarse]++] = {fine, p};
    }
  }
  coarse_structure_ = std::make_unique<BlockStructure>(CoarseStructure());
  coarse_factor_ = std::make_unique<BlockCholesky>(*coarse_structure_);
  coarse_values_.resize(coarse_structure_->num_values());
  coarse_rows_.resize(coarse_structure_->num_rows());
}

void TwoLevelPreconditioner::AddOtherBlocks() {
  for (int block = num_nodes_; block < matrix_.num_blocks(); ++block) {
    Part part;
    part.coarse = Z_.num_coarse++;
    part.weight = 1.0;
    Z_.parts.push_back(part);
    Z_.begins.push_back(static_cast<int>(Z_.parts.size()));
  }
}

BlockStructure TwoLevelPreconditioner::CoarseStructure() const {
  const BlockStructure& fine = matrix_.structure();
  std::vector<BlockPair> pairs;
  // The last column for which a coarse block was found to be its neighbour.
  std::vector<int> seen(Z_.num_coarse, -1);
  for (int column = 0; column < Z_.num_coarse; ++column) {
    seen[column] = column;
    const auto add_block = [&](int block) {
      for (const Part* part = begin(block); part != end(block); ++part) {
        if (part->coarse <= column || seen[part->coarse] == column) continue;
        seen[part->coarse] = column;
        pairs.push_back({part->coarse, column, true});
      }
    };
    for (int c = column_begins_[column]; c < column_begins_[column + 1]; ++c) {
      const int j = column_parts_[c].fine;
      for (const PrimalMatrix::Neighbor* n = matrix_.begin(j); n != matrix_.end(j); ++n) {
        if (!fine.is_dual(n->block)) {
          add_block(n->block);
          continue;
        }
        ForEachOfDual(n->block, [&](const PrimalMatrix::Neighbor& of) { add_block(of.block); });
      }
    }
  }
  std::vector<int> sizes(Z_.num_coarse, kNode);
  for (int block = num_nodes_; block < matrix_.num_blocks(); ++block) {
    sizes[begin(block)->coarse] = fine.size(block);
  }
  return BlockStructure(std::move(sizes), pairs);
}

// Calls `visit` with the primal neighbours of a dual block.
template <typename Visitor>
void TwoLevelPreconditioner::ForEachOfDual(int dual, const Visitor& visit) const {
  for (const PrimalMatrix::Neighbor* n = matrix_.begin(dual); n != matrix_.end(dual); ++n) {
    if (n->block != dual) visit(*n);
  }
}

// Computes J Z for the rows J of a dual block, as one block for each coarse block that it sees.
void TwoLevelPreconditioner::MultiplyDual(int dual, DualRows* rows) const {
  const BlockStructure& fine = matrix_.structure();
  const int height = fine.size(dual);
  rows->count = 0;
  NodeBlock J;
  NodeBlock right;
  ForEachOfDual(dual, [&](const PrimalMatrix::Neighbor& n) {
    J = Eigen::Map<const Eigen::MatrixXd>(matrix_.values(n.entry), height, fine.size(n.block));
    for (const Part* part = begin(n.block); part != end(n.block); ++part) {
      if (IsNode(n.block)) {
        MultiplyFromTheRight(*part, J, &right);
      } else {
        right = J;
      }
      rows->Add(part->coarse, right);
    }
  });
}

// Adds the part of J^T J that the dual blocks contribute to one column, where `sum_of(coarse)` is
// the block of a row.
template <typename Sum>
void TwoLevelPreconditioner::AddDuals(int coarse, DualRows* rows, const Sum& sum_of) const {
  const BlockStructure& fine = matrix_.structure();
  const auto has_column = [&](int block) {
    return std::any_of(begin(block), end(block), [&](const Part& p) { return p.coarse == coarse; });
  };
  for (int c = column_begins_[coarse]; c < column_begins_[coarse + 1]; ++c) {
    const int j = column_parts_[c].fine;
    for (const auto* n = matrix_.end(j); n != matrix_.begin(j) && fine.is_dual((n - 1)->block);) {
      const int dual = (--n)->block;
      // It is taken at the first of its blocks that follow this coarse one.
      const PrimalMatrix::Neighbor* first = matrix_.begin(dual);
      while (!has_column(first->block)) ++first;
      if (first->block != j) continue;
      MultiplyDual(dual, rows);
      const NodeBlock& column = rows->Of(coarse);
      for (int r = 0; r < rows->count; ++r) {
        if (rows->coarse[r] < coarse) continue;
        sum_of(rows->coarse[r]).noalias() += rows->blocks[r].transpose().lazyProduct(column);
      }
    }
  }
}

// Computes the blocks of Z^T A Z in one column, with `places` as memory: one entry for each coarse
// block.
void TwoLevelPreconditioner::UpdateColumn(int coarse, std::vector<int>* places, DualRows* rows) {
  const BlockStructure& fine = matrix_.structure();
  const BlockStructure& structure = *coarse_structure_;
  for (int e = structure.column_begin(coarse); e < structure.column_begin(coarse + 1); ++e) {
    (*places)[structure.entry_row(e)] = e;
    std::fill_n(&coarse_values_[structure.value_offset(e)],
                structure.size(structure.entry_row(e)) * structure.size(coarse),
                0.0);
  }
  const auto sum_of = [&](int row) {
    return Eigen::Map<Eigen::MatrixXd>(&coarse_values_[structure.value_offset((*places)[row])],
                                       structure.size(row),
                                       structure.size(coarse));
  };
  NodeBlock block;
  NodeBlock right;
  for (int c = column_begins_[coarse]; c < column_begins_[coarse + 1]; ++c) {
    const int j = column_parts_[c].fine;
    const Part& column_part = Z_.parts[column_parts_[c].part];
    for (const PrimalMatrix::Neighbor* n = matrix_.begin(j); n != matrix_.end(j); ++n) {
      const int i = n->block;
      if (fine.is_dual(i)) break;
      if (std::all_of(begin(i), end(i), [&](const Part& p) { return p.coarse < coarse; })) continue;
      // The block (i, j) of A; the list of j's neighbours has it as (j, i).
      using Values = Eigen::Map<const Eigen::MatrixXd>;
      if (n->transposed || i == j) {
        block = Values(matrix_.values(n->entry), fine.size(i), fine.size(j));
      } else {
        block = Values(matrix_.values(n->entry), fine.size(j), fine.size(i)).transpose();
      }
      if (i == j) {
        for (int r = 0; r < fine.size(i); ++r) {
          block(r, r) += matrix_.diagonal(fine.row_offset(i) + r);
        }
      }
      if (IsNode(j)) {
        MultiplyFromTheRight(column_part, block, &right);
      } else {
        right = block;
      }
      for (const Part* part = begin(i); part != end(i); ++part) {
        if (part->coarse < coarse) continue;
        auto sum = sum_of(part->coarse);
        if (IsNode(i)) {
          AddFromTheLeft(*part, right, &sum);
        } else {
          sum += right;
        }
      }
    }
  }
  AddDuals(coarse, rows, sum_of);
}

bool TwoLevelPreconditioner::Update(int num_threads) {
  if (!jacobi_.Update(num_threads)) return false;
  ParallelFor(num_threads, Z_.num_coarse, [&](int begin, int end) {
    std::vector<int> places(Z_.num_coarse, -1);
    DualRows rows;
    for (int c = begin; c < end; ++c) UpdateColumn(c, &places, &rows);
  });
  const Eigen::VectorXd shift = kCoarseShift * coarse_structure_->Diagonal(coarse_values_);
  return coarse_factor_->Factorize(coarse_values_.data(), shift, num_threads);
}

void TwoLevelPreconditioner::Apply(const Eigen::VectorXd& x, int num_threads, Eigen::VectorXd* y) {
  const BlockStructure& fine = matrix_.structure();
  const BlockStructure& structure = *coarse_structure_;
  // Z^T x.
  ParallelFor(num_threads, Z_.num_coarse, [&](int begin, int end) {
    for (int c = begin; c < end; ++c) {
      auto sum = coarse_rows_.segment(structure.row_offset(c), structure.size(c));
      sum.setZero();
      for (int p = column_begins_[c]; p < column_begins_[c + 1]; ++p) {
        const int j = column_parts_[p].fine;
        const Part& part = Z_.parts[column_parts_[p].part];
        const auto rows = x.segment(fine.row_offset(j), fine.size(j));
        sum += part.weight * rows;
        if (!IsNode(j)) continue;
        for (int axis = 0; axis < 3; ++axis) {
          sum.segment<3>(3 * axis) += (part.weight * part.lever[axis]) * rows.tail<3>();
        }
      }
    }
  });
  const Eigen::VectorXd solution = coarse_factor_->Solve(coarse_rows_);
  jacobi_.Apply(x, num_threads, y);
  ParallelFor(num_threads, matrix_.num_blocks(), [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      auto rows = y->segment(fine.row_offset(i), fine.size(i));
      for (const Part* part = begin(i); part != end(i); ++part) {
        const auto change =
            solution.segment(structure.row_offset(part->coarse), structure.size(part->coarse));
        rows += part->weight * change;
        if (!IsNode(i)) continue;
        for (int axis = 0; axis < 3; ++axis) {
          rows.tail<3>() += (part->weight * part->lever[axis]) * change.segment<3>(3 * axis);
        }
      }
    }
  });
}

}  // namespace ceres_ed
