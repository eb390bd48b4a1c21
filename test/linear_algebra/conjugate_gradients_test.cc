#include <ceres_ed/linear_algebra/conjugate_gradients.h>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// Returns a graph's Laplacian of a ring, squared, with some weight on every third vertex alone.
Eigen::MatrixXd MakeMatrix(int size) {
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < size; ++i) {
    laplacian(i, i) = 1.0;
    laplacian(i, (i + 1) % size) -= 0.5;
    laplacian(i, (i + size - 1) % size) -= 0.5;
  }
  Eigen::MatrixXd A = laplacian.transpose() * laplacian;
  for (int i = 0; i < size; ++i) A(i, i) += i % 3 == 0 ? 1.0 : 1e-3;
  return A;
}

ThreeColumns MakeRightSide(int size) {
  ThreeColumns rhs(size, 3);
  for (int i = 0; i < size; ++i) rhs.row(i) << 1.0, 0.5 * i, 0.0;
  return rhs;
}

TEST(ConjugateGradients, SolveAsTheDenseFactorDoes) {
  const Eigen::MatrixXd A = MakeMatrix(200);
  const ThreeColumns rhs = MakeRightSide(200);
  ConjugateGradientOptions options;
  options.tolerance = 1e-10;
  ThreeColumns solution;
  ASSERT_TRUE(SolveByConjugateGradients(A.sparseView(), rhs, options, &solution));
  const Eigen::MatrixXd truth = A.llt().solve(Eigen::MatrixXd(rhs));
  EXPECT_LT((solution - truth).norm(), 1e-7 * truth.norm());
  EXPECT_EQ(solution.col(2).norm(), 0.0);
}

TEST(ConjugateGradients, AreADescentStepWhenTheyEndEarly) {
  const Eigen::MatrixXd A = MakeMatrix(200);
  const ThreeColumns rhs = MakeRightSide(200);
  double before = 0.0;
  for (const int iterations : {1, 3, 9}) {
    ConjugateGradientOptions options;
    options.max_iterations = iterations;
    ThreeColumns x;
    ASSERT_TRUE(SolveByConjugateGradients(A.sparseView(), rhs, options, &x));
    const double value = 0.5 * (x.transpose() * (A * x)).trace() - (x.transpose() * rhs).trace();
    EXPECT_LT(value, before);
    before = value;
  }
}

TEST(ConjugateGradients, EndWhenTheyAreToldTo) {
  int calls = 0;
  ConjugateGradientOptions options;
  options.should_stop = [&calls] { return ++calls == 3; };
  ThreeColumns x;
  EXPECT_FALSE(
      SolveByConjugateGradients(MakeMatrix(200).sparseView(), MakeRightSide(200), options, &x));
  EXPECT_EQ(calls, 3);
}

}  // namespace
}  // namespace ceres_ed
