// Compares products, preconditioners and conjugate gradients with dense linear algebra.
#include <ceres_ed/linear_algebra/iterative/block_conjugate_gradients.h>
#include <ceres_ed/linear_algebra/iterative/block_jacobi.h>
#include <ceres_ed/linear_algebra/iterative/incomplete_cholesky.h>
#include <ceres_ed/linear_algebra/iterative/two_level_preconditioner.h>

#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>
#include <test/linear_algebra/dense_matrix.h>

namespace ceres_ed {
namespace {

// A chain of nodes with a camera that all of them see, and with dual blocks on some of them.
struct Chain {
  explicit Chain(int num_nodes, bool has_camera = true, int num_dual = 2)
      : structure(Sizes(num_nodes, has_camera, num_dual),
                  Pairs(num_nodes, has_camera, num_dual),
                  num_dual),
        matrix(structure) {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    values.resize(structure.num_values());
    // Small blocks off the diagonal, and a diagonal that dominates them.
    for (int column = 0; column < structure.num_blocks(); ++column) {
      for (int e = structure.column_begin(column); e < structure.column_begin(column + 1); ++e) {
        const int row = structure.entry_row(e);
        Eigen::Map<Eigen::MatrixXd> block(
            &values[structure.value_offset(e)], structure.size(row), structure.size(column));
        for (double& value : block.reshaped()) value = normal(random);
        if (row != column) continue;
        const Eigen::MatrixXd square = block;
        block = structure.is_dual(row)
                    ? Eigen::MatrixXd(-Eigen::MatrixXd::Identity(block.rows(), block.cols()))
                    : Eigen::MatrixXd(square * square.transpose());
        if (!structure.is_dual(row)) block.diagonal().array() += 40.0;
      }
    }
    diagonal = Eigen::VectorXd::LinSpaced(structure.num_rows(), 0.5, 2.0);
    diagonal.tail(structure.num_rows() - structure.num_primal_rows()).setZero();
    matrix.SetValues(values.data(), diagonal);
  }

  static std::vector<int> Sizes(int num_nodes, bool has_camera, int num_dual) {
    std::vector<int> sizes(num_nodes, 12);
    if (has_camera) sizes.push_back(6);
    sizes.insert(sizes.end(), num_dual, 3);
    return sizes;
  }

  static std::vector<BlockPair> Pairs(int num_nodes, bool has_camera, int num_dual) {
    std::vector<BlockPair> pairs;
    for (int i = 0; i + 1 < num_nodes; ++i) pairs.push_back({i + 1, i, true});
    if (has_camera) {
      for (int i = 0; i < num_nodes; ++i) pairs.push_back({num_nodes, i, true});
    }
    for (int d = 0; d < num_dual; ++d) {
      const int dual = num_nodes + (has_camera ? 1 : 0) + d;
      pairs.push_back({dual, d, true});
      pairs.push_back({dual, num_nodes - 1, true});
    }
    return pairs;
  }

  // H + J^T J + diag(d), from the dense matrix of all blocks.
  Eigen::MatrixXd Dense() const {
    const Eigen::MatrixXd all = DenseOf(structure, values);
    const int n = structure.num_primal_rows();
    const Eigen::MatrixXd J = all.bottomLeftCorner(all.rows() - n, n);
    Eigen::MatrixXd A = all.topLeftCorner(n, n) + J.transpose() * J;
    A.diagonal() += diagonal.head(n);
    return A;
  }

  BlockStructure structure;
  PrimalMatrix matrix;
  std::vector<double> values;
  Eigen::VectorXd diagonal;
};

// Every third node is a coarse one, and the others follow the two beside them.
AffineProlongation EveryThird(int num_nodes) {
  AffineProlongation Z;
  Z.num_coarse = (num_nodes + 2) / 3;
  for (int i = 0; i < num_nodes; ++i) {
    const int left = i / 3;
    const double share = (i % 3) / 3.0;
    Z.parts.push_back({left, 1.0 - share, Eigen::Vector3d(i - 3.0 * left, 0.1, -0.2)});
    if (share > 0.0 && left + 1 < Z.num_coarse) {
      Z.parts.push_back({left + 1, share, Eigen::Vector3d(i - 3.0 * (left + 1), -0.1, 0.3)});
    }
    Z.begins.push_back(static_cast<int>(Z.parts.size()));
  }
  return Z;
}

// Z as a dense matrix, column for column as AffineProlongation says, and the identity elsewhere.
Eigen::MatrixXd DenseOf(const AffineProlongation& Z, int num_other_rows) {
  Eigen::MatrixXd dense =
      Eigen::MatrixXd::Zero(12 * Z.num_fine() + num_other_rows, 12 * Z.num_coarse + num_other_rows);
  for (int i = 0; i < Z.num_fine(); ++i) {
    for (int p = Z.begins[i]; p < Z.begins[i + 1]; ++p) {
      const AffineProlongation::Part& part = Z.parts[p];
      for (int column = 0; column < 12; ++column) {
        Eigen::Matrix<double, 3, 4> change = Eigen::Matrix<double, 3, 4>::Zero();
        change.reshaped()[column] = 1.0;
        // The change of the coarse node as an affine map, at the place of the fine one.
        Eigen::Matrix<double, 3, 4> fine = change;
        fine.col(3) += change.leftCols<3>() * part.lever;
        dense.block<12, 1>(12 * i, 12 * part.coarse + column) += part.weight * fine.reshaped();
      }
    }
  }
  dense.bottomRightCorner(num_other_rows, num_other_rows).setIdentity();
  return dense;
}

std::unique_ptr<Preconditioner> Make(const std::string& name, const Chain& chain, int num_nodes) {
  if (name == "block_jacobi") return std::make_unique<BlockJacobi>(chain.matrix);
  if (name == "incomplete_cholesky") return std::make_unique<IncompleteCholesky>(chain.matrix);
  return std::make_unique<TwoLevelPreconditioner>(chain.matrix, EveryThird(num_nodes));
}

const char* const kNames[] = {"block_jacobi", "incomplete_cholesky", "two_level"};

// The inverse of a preconditioner as a dense matrix.
Eigen::MatrixXd DenseOf(Preconditioner* M, int size) {
  Eigen::MatrixXd inverse(size, size);
  Eigen::VectorXd column;
  for (int c = 0; c < size; ++c) {
    M->Apply(Eigen::VectorXd::Unit(size, c), 1, &column);
    inverse.col(c) = column;
  }
  return inverse;
}

TEST(PrimalMatrix, MultipliesLikeTheDenseMatrixWithItsDualRowsEliminated) {
  for (const bool has_camera : {false, true}) {
    const Chain chain(8, has_camera);
    const Eigen::MatrixXd A = chain.Dense();
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(A.rows(), -1.0, 2.0);
    Eigen::VectorXd y;
    chain.matrix.Multiply(x, 1, &y);
    EXPECT_LT((y - A * x).norm(), 1e-13 * (A * x).norm());
    Eigen::VectorXd by_threads;
    chain.matrix.Multiply(x, 3, &by_threads);
    EXPECT_EQ(y, by_threads);
  }
}

TEST(PrimalMatrix, HasTheDiagonalBlocksOfTheDenseMatrix) {
  const Chain chain(8);
  const Eigen::MatrixXd A = chain.Dense();
  for (int b = 0; b < chain.matrix.num_blocks(); ++b) {
    const int row = chain.structure.row_offset(b);
    const int size = chain.structure.size(b);
    EXPECT_LT((chain.matrix.DiagonalBlock(b) - A.block(row, row, size, size)).norm(), 1e-12);
  }
}

TEST(BlockJacobi, IsTheInverseOfTheBlocksOfNodesWithTheBorderOfTheCamera) {
  const int num_nodes = 8;
  const Chain chain(num_nodes);
  Eigen::MatrixXd arrow = chain.Dense();
  for (int a = 0; a < num_nodes; ++a) {
    for (int b = 0; b < num_nodes; ++b) {
      if (a != b) arrow.block<12, 12>(12 * a, 12 * b).setZero();
    }
  }
  ASSERT_EQ(Eigen::LLT<Eigen::MatrixXd>(arrow).info(), Eigen::Success);
  BlockJacobi jacobi(chain.matrix);
  ASSERT_TRUE(jacobi.Update(1));
  const auto size = static_cast<int>(arrow.rows());
  EXPECT_LT((DenseOf(&jacobi, size) * arrow - Eigen::MatrixXd::Identity(size, size)).norm(), 1e-10);
}

// Eliminating a chain from its end gives no fill, so that nothing is left out.
TEST(IncompleteCholesky, IsExactWhereThereIsNoFill) {
  const Chain chain(8, /*has_camera=*/true, /*num_dual=*/0);
  IncompleteCholesky factor(chain.matrix);
  ASSERT_TRUE(factor.Update(1));
  const Eigen::MatrixXd A = chain.Dense();
  const auto size = static_cast<int>(A.rows());
  EXPECT_LT((DenseOf(&factor, size) * A - Eigen::MatrixXd::Identity(size, size)).norm(), 1e-10);
}

TEST(TwoLevelPreconditioner, AddsTheCoarseSolutionToThatOfTheBlocks) {
  const int num_nodes = 9;
  const Chain chain(num_nodes);
  const Eigen::MatrixXd A = chain.Dense();
  const auto size = static_cast<int>(A.rows());
  BlockJacobi jacobi(chain.matrix);
  ASSERT_TRUE(jacobi.Update(1));
  TwoLevelPreconditioner two_level(chain.matrix, EveryThird(num_nodes));
  ASSERT_TRUE(two_level.Update(2));
  const Eigen::MatrixXd Z = DenseOf(EveryThird(num_nodes), size - 12 * num_nodes);
  const Eigen::MatrixXd coarse = Z.transpose() * A * Z;
  const Eigen::MatrixXd expected =
      DenseOf(&jacobi, size) + Z * coarse.llt().solve(Eigen::MatrixXd(Z.transpose()));
  EXPECT_LT((DenseOf(&two_level, size) - expected).norm(), 1e-8 * expected.norm());
}

TEST(Preconditioners, AreSymmetricAndPositiveDefinite) {
  const int num_nodes = 9;
  const Chain chain(num_nodes);
  for (const char* name : kNames) {
    const std::unique_ptr<Preconditioner> M = Make(name, chain, num_nodes);
    ASSERT_TRUE(M->Update(1)) << name;
    const Eigen::MatrixXd inverse = DenseOf(M.get(), chain.matrix.num_rows());
    EXPECT_LT((inverse - inverse.transpose()).norm(), 1e-12 * inverse.norm()) << name;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(inverse);
    EXPECT_GT(eigen.eigenvalues().minCoeff(), 0.0) << name;
  }
}

TEST(BlockConjugateGradients, SolveLikeADenseFactorWithEveryPreconditioner) {
  const int num_nodes = 30;
  const Chain chain(num_nodes);
  const Eigen::MatrixXd A = chain.Dense();
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(A.rows(), -1.0, 2.0);
  const Eigen::VectorXd expected = A.llt().solve(b);
  for (const char* name : kNames) {
    const std::unique_ptr<Preconditioner> M = Make(name, chain, num_nodes);
    ASSERT_TRUE(M->Update(1)) << name;
    BlockGradientOptions options;
    options.tolerance = 1e-12;
    Eigen::VectorXd x;
    const BlockGradientSummary summary =
        SolveByBlockGradients(chain.matrix, b, options, M.get(), &x);
    EXPECT_FALSE(summary.failed) << name;
    EXPECT_LE(summary.relative_residual, options.tolerance) << name;
    EXPECT_LT((x - expected).norm(), 1e-10 * expected.norm()) << name;
    options.num_threads = 3;
    Eigen::VectorXd by_threads;
    SolveByBlockGradients(chain.matrix, b, options, M.get(), &by_threads);
    EXPECT_EQ(x, by_threads) << name;
  }
}

// Wherever they end, so that the decrease that a step predicts is that of an exact one.
TEST(BlockConjugateGradients, EndAtTheBestPointAlongTheirSolution) {
  const Chain chain(30);
  const Eigen::MatrixXd A = chain.Dense();
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(A.rows(), -1.0, 2.0);
  BlockJacobi jacobi(chain.matrix);
  ASSERT_TRUE(jacobi.Update(1));
  BlockGradientOptions options;
  for (const int iterations : {1, 2, 5}) {
    options.tolerance = 1e-15;
    options.max_iterations = iterations;
    Eigen::VectorXd x;
    EXPECT_EQ(SolveByBlockGradients(chain.matrix, b, options, &jacobi, &x).iterations, iterations);
    EXPECT_NEAR(x.dot(A * x), b.dot(x), 1e-12 * b.dot(x));
  }
}

TEST(BlockConjugateGradients, FailWhereTheMatrixIsNotPositiveDefinite) {
  Chain chain(5, /*has_camera=*/false, /*num_dual=*/0);
  BlockJacobi jacobi(chain.matrix);
  ASSERT_TRUE(jacobi.Update(1));
  chain.diagonal.setConstant(-1e4);
  chain.matrix.SetValues(chain.values.data(), chain.diagonal);
  Eigen::VectorXd x;
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(chain.matrix.num_rows());
  EXPECT_TRUE(SolveByBlockGradients(chain.matrix, b, {}, &jacobi, &x).failed);
  EXPECT_FALSE(jacobi.Update(1));
}

}  // namespace
}  // namespace ceres_ed
