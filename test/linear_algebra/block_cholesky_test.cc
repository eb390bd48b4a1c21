#include "ceres_ed/linear_algebra/block_cholesky.h"

#include <algorithm>
#include <random>
#include <vector>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>
#include <test/linear_algebra/dense_matrix.h>

namespace ceres_ed {
namespace {

TEST(BlockCholesky, SolvesWhatDenseCholeskySolves) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const std::vector<int> sizes = {12, 6, 12, 12, 6, 12, 12};
  const std::vector<BlockPair> pairs = {
      {6, 0}, {1, 2}, {3, 1}, {5, 4}, {4, 5}, {6, 3}, {2, 0}, {0, 5}};
  const BlockStructure structure(sizes, pairs);
  std::vector<double> values(structure.num_values());
  for (double& value : values) value = uniform(random);
  const Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(structure.num_rows(), 30.0);
  Eigen::MatrixXd dense = DenseOf(structure, values);
  dense.diagonal() += diagonal;
  Eigen::VectorXd rhs(structure.num_rows());
  for (double& value : rhs) value = uniform(random);

  BlockCholesky cholesky(structure);
  ASSERT_TRUE(cholesky.Factorize(values.data(), diagonal));
  const Eigen::VectorXd expected = dense.llt().solve(rhs);
  EXPECT_LT((cholesky.Solve(rhs) - expected).norm(), 1e-12 * expected.norm());
  // A failed factorisation leaves an object that can still be used.
  EXPECT_FALSE(cholesky.Factorize(values.data(), -diagonal));
  ASSERT_TRUE(cholesky.Factorize(values.data(), diagonal));
  EXPECT_LT((cholesky.Solve(rhs) - expected).norm(), 1e-12 * expected.norm());
}

// Checks the factor of a matrix whose rows are permuted except at the end.
TEST(BlockCholesky, EndsInTheFactorOfTheSchurComplementOfTheTrailingBlocks) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const std::vector<BlockPair> pairs = {
      {6, 0}, {1, 2}, {3, 1}, {5, 4}, {6, 3}, {2, 0}, {0, 5}, {4, 3}};
  const BlockStructure structure({12, 6, 12, 12, 6, 12, 12}, pairs);
  std::vector<double> values(structure.num_values());
  for (double& value : values) value = uniform(random);
  const Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(structure.num_rows(), 30.0);
  Eigen::MatrixXd A = DenseOf(structure, values);
  A.diagonal() += diagonal;
  for (const int trailing : {0, 1, 3, 7}) {
    const Eigen::Index n = structure.row_offset(7 - trailing);
    const Eigen::Index rest = A.rows() - n;
    Eigen::MatrixXd schur = A.bottomRightCorner(rest, rest);
    if (n > 0) {
      schur -= A.bottomLeftCorner(rest, n) *
               A.topLeftCorner(n, n).llt().solve(A.topRightCorner(n, rest));
    }
    BlockCholesky cholesky(structure, trailing);
    ASSERT_TRUE(cholesky.Factorize(values.data(), diagonal));
    const Eigen::MatrixXd L = cholesky.TrailingFactor();
    EXPECT_LT((L - Eigen::MatrixXd(schur.llt().matrixL())).norm(), 1e-12 * A.norm()) << trailing;
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(A.rows(), -1.0, 2.0);
    const Eigen::VectorXd expected = A.llt().solve(b);
    EXPECT_LT((cholesky.Solve(b) - expected).norm(), 1e-12 * expected.norm());
    EXPECT_LT((cholesky.SolveUpper(cholesky.SolveLower(b)) - expected).norm(),
              1e-12 * expected.norm());
  }
}

// Returns the structure of nodes on a grid of `columns` x `rows`, each joined to its 8 neighbours,
// and a camera that the nodes of the first column see. `share_points(a, b)` says whether the affine
// parts of two nodes are coupled.
template <typename SharePoints>
BlockStructure Sheet(int columns, int rows, const SharePoints& share_points) {
  std::vector<BlockPair> pairs;
  const int camera = columns * rows;
  for (int x = 0; x < columns; ++x) {
    for (int y = 0; y < rows; ++y) {
      const int node = x * rows + y;
      if (x == 0) pairs.push_back({camera, node, true});
      for (const auto& [dx, dy] :
           {std::pair(0, 1), std::pair(1, -1), std::pair(1, 0), std::pair(1, 1)}) {
        if (x + dx >= columns || y + dy < 0 || y + dy >= rows) continue;
        const int other = (x + dx) * rows + y + dy;
        pairs.push_back({node, other, share_points(node, other)});
      }
    }
  }
  std::vector<int> sizes(camera, 12);
  sizes.push_back(6);
  return BlockStructure(sizes, pairs);
}

TEST(BlockCholesky, KnowsTheDeterminant) {
  const BlockStructure structure = Sheet(6, 5, [](int a, int b) { return a < 12 && b < 12; });
  const std::vector<double> values = RandomValues(structure, 7);
  const Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(structure.num_rows(), 60.0);
  Eigen::MatrixXd dense = DenseOf(structure, values);
  dense.diagonal() += diagonal;
  BlockCholesky cholesky(structure);
  ASSERT_TRUE(cholesky.Factorize(values.data(), diagonal));
  const double expected =
      2.0 * Eigen::MatrixXd(dense.llt().matrixL()).diagonal().array().log().sum();
  EXPECT_NEAR(cholesky.LogDeterminant(), expected, 1e-11 * expected);
}

TEST(BlockCholesky, EliminatesLoneHeadsFirst) {
  // The nodes of the left half share points, so that there are nodes of both kinds and a border
  // between them.
  const auto left = [](int a, int b) { return a < 42 && b < 42; };
  const BlockStructure mixed = Sheet(12, 7, left);
  const BlockStructure whole = Sheet(12, 7, [](int, int) { return true; });
  const std::vector<double> values = RandomValues(mixed, 5);
  const Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(mixed.num_rows(), 60.0);
  Eigen::MatrixXd dense = DenseOf(mixed, values);
  dense.diagonal() += diagonal;
  const Eigen::VectorXd rhs = Eigen::VectorXd::LinSpaced(mixed.num_rows(), -1.0, 2.0);
  const Eigen::VectorXd expected = dense.llt().solve(rhs);
  for (const BlockStructure* structure : {&mixed, &whole}) {
    BlockCholesky cholesky(*structure);
    ASSERT_TRUE(cholesky.Factorize(values.data(), diagonal));
    EXPECT_LT((cholesky.Solve(rhs) - expected).norm(), 1e-12 * expected.norm());
  }
  const BlockStructure edges = Sheet(40, 40, [](int, int) { return false; });
  const BlockStructure points = Sheet(40, 40, [](int, int) { return true; });
  EXPECT_LT(BlockCholesky(edges).NumOperations(), 0.3 * BlockCholesky(points).NumOperations());
}

// Nodes that share points are coupled in two ways: once by products of their Jacobians, and once by
// a dual block per point:
//   [H J^T; J -I] [x; y] = [b; 0]  <=>  (H + J^T J) x = b
TEST(BlockCholesky, EliminatesDualBlocks) {
  for (const bool many : {false, true}) {
    const int columns = many ? 16 : 6;
    const int rows = many ? 9 : 4;
    const int num_nodes = columns * rows;
    const BlockStructure primal = Sheet(columns, rows, [](int, int) { return false; });
    std::vector<double> values = RandomValues(primal, 5);
    std::vector<BlockPair> pairs = primal.Pairs();
    std::vector<int> sizes(num_nodes, 12);
    sizes.push_back(6);
    const int num_points = num_nodes / 2;
    for (int i = 0; i < num_points; ++i) {
      sizes.push_back(1 + i % 3);
      const int corner = (i % (columns - 1)) * rows + i % (rows - 1);
      for (const int node : {corner, corner + 1, corner + rows, corner + rows + 1}) {
        pairs.push_back({num_nodes + 1 + i, node, true});
      }
    }
    const BlockStructure structure(sizes, pairs, num_points);
    // The primal part has values of its own; the Jacobians are random; the dual diagonal is -1.
    std::mt19937 random(6);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::vector<double> all(structure.num_values(), 0.0);
    for (int j = 0; j < structure.num_blocks(); ++j) {
      for (int e = structure.column_begin(j); e < structure.column_begin(j + 1); ++e) {
        const int i = structure.entry_row(e);
        double* block = &all[structure.value_offset(e)];
        const int size = structure.size(i) * structure.size(j);
        if (!structure.is_dual(i)) {
          const int from = primal.FindEntry(i, j);
          std::copy_n(&values[primal.value_offset(from)], size, block);
        } else if (i == j) {
          for (int k = 0; k < structure.size(i); ++k) block[k * structure.size(i) + k] = -1.0;
        } else {
          for (int k = 0; k < size; ++k) block[k] = uniform(random);
        }
      }
    }
    const int n = primal.num_rows();
    Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(structure.num_rows());
    diagonal.head(n).setConstant(60.0);
    Eigen::MatrixXd dense = DenseOf(structure, all);
    const Eigen::MatrixXd J = dense.bottomLeftCorner(structure.num_rows() - n, n);
    Eigen::MatrixXd H = dense.topLeftCorner(n, n) + J.transpose() * J;
    H.diagonal().array() += 60.0;
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(structure.num_rows());
    rhs.head(n).setLinSpaced(-1.0, 2.0);
    const Eigen::VectorXd expected = H.llt().solve(rhs.head(n));
    for (const int num_threads : {1, 2}) {
      BlockCholesky cholesky(structure);
      ASSERT_TRUE(cholesky.Factorize(all.data(), diagonal, num_threads));
      const Eigen::VectorXd solution = cholesky.Solve(rhs);
      EXPECT_LT((solution.head(n) - expected).norm(), 1e-11 * expected.norm());
      EXPECT_LT((solution.tail(J.rows()) - J * expected).norm(), 1e-11 * (J * expected).norm());
    }
  }
}

// A chain whose position is fixed only by one dual unknown, which is joined to all of it. By degree
// alone the dual would come last, and the last row of the chain would be divided by a number close
// to zero.
TEST(BlockCholesky, HoldsWhatIsFreeUntilTheDualsHaveHadTheirSay) {
  constexpr int kLength = 20;
  std::vector<BlockPair> pairs;
  for (int i = 0; i < kLength; ++i) {
    if (i > 0) pairs.push_back({i, i - 1});
    pairs.push_back({kLength, i});
  }
  const BlockStructure structure(std::vector<int>(kLength + 1, 1), pairs, /*num_dual=*/1);
  std::vector<double> values(structure.num_values());
  const auto set = [&](int row, int column, double value) {
    values[structure.value_offset(structure.FindEntry(row, column))] = value;
  };
  for (int i = 0; i < kLength; ++i) {
    set(i, i, i == 0 || i + 1 == kLength ? 1.0 : 2.0);
    if (i > 0) set(i, i - 1, -1.0);
    set(kLength, i, 1.0);
  }
  set(kLength, kLength, -1.0);
  Eigen::VectorXd damping = Eigen::VectorXd::Constant(kLength + 1, 1e-15);
  damping[kLength] = 0.0;
  Eigen::VectorXd rhs = Eigen::VectorXd::LinSpaced(kLength + 1, 1.0, 2.0);
  rhs[kLength] = 0.0;
  BlockCholesky cholesky(structure);
  ASSERT_TRUE(cholesky.Factorize(values.data(), damping));
  const Eigen::VectorXd solution = cholesky.Solve(rhs);
  EXPECT_LT((DenseOf(structure, values) * solution - rhs).norm(), 1e-12 * rhs.norm());
}

// The matrix is large enough for several tasks, for updates on several threads and for both
// orderings.
TEST(BlockCholesky, GivesTheSameBitsOnAnyNumberOfThreads) {
  const BlockStructure structure = Sheet(60, 30, [](int, int) { return true; });
  const std::vector<double> values = RandomValues(structure, 5);
  const Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(structure.num_rows(), 120.0);
  const Eigen::VectorXd rhs = Eigen::VectorXd::LinSpaced(structure.num_rows(), -1.0, 2.0);
  BlockCholesky serial(structure);
  ASSERT_TRUE(serial.Factorize(values.data(), diagonal, 1));
  const Eigen::VectorXd expected = serial.Solve(rhs);
  for (const int num_threads : {2, 3}) {
    BlockCholesky parallel(structure);
    ASSERT_TRUE(parallel.Factorize(values.data(), diagonal, num_threads));
    EXPECT_EQ(parallel.Solve(rhs), expected) << num_threads;
  }
  // The residual, computed from the block structure itself.
  Eigen::VectorXd product = diagonal.cwiseProduct(expected);
  for (int j = 0; j < structure.num_blocks(); ++j) {
    for (int e = structure.column_begin(j); e < structure.column_begin(j + 1); ++e) {
      const int i = structure.entry_row(e);
      Eigen::MatrixXd block = Eigen::Map<const Eigen::MatrixXd>(
          &values[structure.value_offset(e)], structure.size(i), structure.size(j));
      if (i == j) block = Eigen::MatrixXd(block.selfadjointView<Eigen::Lower>());
      product.segment(structure.row_offset(i), structure.size(i)) +=
          block * expected.segment(structure.row_offset(j), structure.size(j));
      if (i == j) continue;
      product.segment(structure.row_offset(j), structure.size(j)) +=
          block.transpose() * expected.segment(structure.row_offset(i), structure.size(i));
    }
  }
  EXPECT_LT((product - rhs).norm(), 1e-12 * rhs.norm());
}

// Tasks keep the updates of whole subtrees until all of them have ended.
TEST(BlockCholesky, NeedsLessMemoryForUpdatesWithOneThread) {
  const BlockStructure structure = Sheet(60, 30, [](int, int) { return true; });
  const std::vector<double> values = RandomValues(structure, 5);
  const Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(structure.num_rows(), 120.0);
  FactorMemory one, two;
  ASSERT_TRUE(BlockCholesky(structure, 0, &one).Factorize(values.data(), diagonal, 1));
  ASSERT_TRUE(BlockCholesky(structure, 0, &two).Factorize(values.data(), diagonal, 2));
  EXPECT_LT(one.updates.size(), 0.7 * two.updates.size());
}

TEST(BlockStructure, FindsWhatItHasAndNothingElse) {
  const BlockStructure structure({12, 6, 12}, {{0, 2}, {2, 0}});
  EXPECT_EQ(structure.num_entries(), 4);
  EXPECT_EQ(structure.entry_row(structure.FindEntry(2, 0)), 2);
  EXPECT_EQ(structure.FindEntry(1, 0), -1);
  EXPECT_EQ(structure.FindEntry(2, 1), -1);
  EXPECT_EQ(structure.num_values(), 12u * 12 + 12 * 12 + 6 * 6 + 12 * 12);
}

}  // namespace
}  // namespace ceres_ed
