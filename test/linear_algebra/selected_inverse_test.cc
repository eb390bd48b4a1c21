// Compares entries of the selected inverse with a dense inverse.
#include <ceres_ed/linear_algebra/block_cholesky.h>

#include <algorithm>
#include <vector>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>
#include <test/linear_algebra/dense_matrix.h>

namespace ceres_ed {
namespace {

// A sheet of nodes, each joined to those to its right and below it, and a camera that some of them
// see. In the right half no two affine parts share a residual.
BlockStructure Sheet(int columns, int rows) {
  std::vector<BlockPair> pairs;
  const int camera = columns * rows;
  for (int x = 0; x < columns; ++x) {
    for (int y = 0; y < rows; ++y) {
      const int node = x * rows + y;
      const bool affine = x < columns / 2;
      if (x == 0) pairs.push_back({camera, node, true});
      if (x + 1 < columns) pairs.push_back({node + rows, node, affine});
      if (y + 1 < rows) pairs.push_back({node + 1, node, affine});
    }
  }
  std::vector<int> sizes(camera, 12);
  sizes.push_back(6);
  return BlockStructure(sizes, pairs);
}

TEST(SelectedInverse, HasTheInverseWhereTheFactorIs) {
  const BlockStructure structure = Sheet(14, 6);
  const std::vector<double> values = RandomValues(structure, 7);
  const Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(structure.num_rows(), 40.0);
  Eigen::MatrixXd dense = DenseOf(structure, values);
  dense.diagonal() += diagonal;
  const Eigen::MatrixXd Z =
      dense.llt().solve(Eigen::MatrixXd::Identity(dense.rows(), dense.cols()));
  BlockCholesky cholesky(structure);
  ASSERT_TRUE(cholesky.Factorize(values.data(), diagonal));
  const SelectedInverse inverse = cholesky.Invert();
  const double tolerance = 1e-12 * Z.norm();
  Eigen::MatrixXd block;
  int missing = 0;
  for (int i = 0; i < structure.num_blocks(); ++i) {
    for (int j = 0; j < structure.num_blocks(); ++j) {
      const Eigen::MatrixXd expected = Z.block(
          structure.row_offset(i), structure.row_offset(j), structure.size(i), structure.size(j));
      const bool complete = inverse.Block(i, j, &block);
      const int entry = structure.FindEntry(std::max(i, j), std::min(i, j));
      if (entry >= 0 && structure.head_pair(entry)) {
        EXPECT_TRUE(complete) << i << " " << j;
      }
      if (complete) {
        EXPECT_LT((block - expected).norm(), tolerance) << i << " " << j;
        continue;
      }
      ++missing;
      // Each entry that exists equals that of the inverse.
      for (int r = 0; r < block.rows(); ++r) {
        for (int c = 0; c < block.cols(); ++c) {
          if (block(r, c) != 0.0) {
            EXPECT_NEAR(block(r, c), expected(r, c), tolerance);
          }
        }
      }
      // Everything except the part that couples the affine parts of two nodes.
      if (entry >= 0) {
        EXPECT_LT((block.rightCols(3) - expected.rightCols(3)).norm(), tolerance);
        EXPECT_LT((block.bottomRows(3) - expected.bottomRows(3)).norm(), tolerance);
      }
    }
  }
  EXPECT_GT(missing, 0);
}

}  // namespace
}  // namespace ceres_ed
