#include "ceres_ed/linear_algebra/front_kernels.h"

#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// A symmetric and positive definite front with `width` own rows and `update_rows` rows below, and
// its panel in the layout that the kernels expect.
struct TestFront {
  TestFront(int own_rows, int rows_below)
      : width(own_rows),
        update_rows(rows_below),
        below_row(RoundUpRows(width)),
        rows(below_row + RoundUpRows(update_rows)),
        stride(rows + kRowUnit) {
    std::mt19937 random(width * 1000 + update_rows);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const int n = width + update_rows;
    const Eigen::MatrixXd root =
        Eigen::MatrixXd::NullaryExpr(n, n, [&] { return uniform(random); });
    dense = root * root.transpose() + Eigen::MatrixXd::Identity(n, n);
    panel = Eigen::MatrixXd::Zero(stride, width);
    panel.topRows(width) = dense.topLeftCorner(width, width);
    panel.middleRows(below_row, update_rows) = dense.bottomLeftCorner(update_rows, width);
  }

  int width;
  int update_rows;
  int below_row;
  int rows;
  int stride;
  Eigen::MatrixXd dense;
  Eigen::MatrixXd panel;
};

constexpr int kWidths[] = {3, 6, 9, 12, 24, 27, 48, 60, 75};
constexpr int kUpdateRows[] = {0, 3, 8, 21, 60, 250};

TEST(FrontKernels, AreNamed) {
  EXPECT_THAT(FrontKernelName(), ::testing::AnyOfArray({"AVX-512", "AVX2", "plain"}));
}

TEST(FrontKernels, FactorizeWhatDenseCholeskyDoes) {
  for (const int width : kWidths) {
    for (const int update_rows : kUpdateRows) {
      TestFront front(width, update_rows);
      ASSERT_TRUE(FactorizePanel(width, front.rows, front.stride, front.panel.data()));
      const Eigen::MatrixXd L = front.dense.llt().matrixL();
      const Eigen::MatrixXd L11 = front.panel.topRows(width).triangularView<Eigen::Lower>();
      EXPECT_LT((L11 - L.topLeftCorner(width, width)).norm(), 1e-12 * L.norm())
          << width << " " << update_rows;
      EXPECT_LT((front.panel.middleRows(front.below_row, update_rows) -
                 L.bottomLeftCorner(update_rows, width))
                    .norm(),
                1e-12 * L.norm())
          << width << " " << update_rows;
    }
  }
}

TEST(FrontKernels, RefuseWhatIsNotPositiveDefinite) {
  TestFront front(30, 10);
  front.panel(26, 26) = -1.0;
  EXPECT_FALSE(FactorizePanel(30, front.rows, front.stride, front.panel.data()));
  TestFront other(30, 10);
  other.panel(3, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(FactorizePanel(30, other.rows, other.stride, other.panel.data()));
}

// All columns at once give the same bits as strip by strip.
TEST(FrontKernels, MakeUpdatesOfAnyColumns) {
  for (const int width : kWidths) {
    for (const int update_rows : kUpdateRows) {
      if (update_rows == 0) continue;
      TestFront front(width, update_rows);
      const int padded = RoundUpRows(update_rows);
      Eigen::MatrixXd update(padded + kRowUnit, padded);
      OuterProduct product;
      product.width = width;
      product.rows = padded;
      product.L21 = front.panel.data() + front.below_row;
      product.stride = front.stride;
      product.update = update.data();
      product.update_stride = padded + kRowUnit;
      AddOuterProduct(product, 0, padded);
      const Eigen::MatrixXd A = front.panel.middleRows(front.below_row, update_rows);
      const Eigen::MatrixXd expected = -A * A.transpose();
      const Eigen::MatrixXd difference = (update.topLeftCorner(update_rows, update_rows) - expected)
                                             .triangularView<Eigen::Lower>();
      EXPECT_LT(difference.norm(), 1e-13 * expected.norm()) << width << " " << update_rows;

      Eigen::MatrixXd strips = update;
      strips.setZero();
      product.update = strips.data();
      for (int c = 0; c < padded; c += kRowUnit) AddOuterProduct(product, c, c + kRowUnit);
      EXPECT_TRUE(Eigen::MatrixXd((update - strips).topRows(padded).triangularView<Eigen::Lower>())
                      .isZero(0.0));

      // The same values go to strips.
      Eigen::VectorXd triangle = Eigen::VectorXd::Zero(StripsSize(padded));
      OuterProduct packed = product;
      packed.update = triangle.data();
      packed.update_stride = 0;
      AddOuterProduct(packed, 0, padded);
      for (int c = 0; c < padded; ++c) {
        const double* column = triangle.data() + StripOffset(padded, c);
        for (int r = c; r < padded; ++r) ASSERT_EQ(column[r], update(r, c)) << r << " " << c;
      }

      // Added with the opposite sign, the sum is zero.
      product.sign = 1.0;
      product.accumulate = true;
      AddOuterProduct(product, 0, padded);
      EXPECT_TRUE(
          Eigen::MatrixXd(strips.topRows(padded).triangularView<Eigen::Lower>()).isZero(0.0));
    }
  }
}

TEST(FrontKernels, StoreALowerTriangleInLittleMoreThanItsSize) {
  EXPECT_EQ(StripsSize(kRowUnit), std::size_t{kRowUnit * kRowUnit});
  for (const int rows : {2 * kRowUnit, 20 * kRowUnit}) {
    std::vector<int> owners(StripsSize(rows), -1);
    for (int c = 0; c < rows; ++c) {
      for (int r = c; r < rows; ++r) {
        const std::ptrdiff_t place = StripOffset(rows, c) + r;
        ASSERT_GE(place, 0);
        ASSERT_LT(place, static_cast<std::ptrdiff_t>(owners.size()));
        EXPECT_EQ(owners[place], -1) << r << " " << c;
        owners[place] = c;
      }
    }
    EXPECT_EQ(owners.size(), rows * (rows + kRowUnit) / 2u);
  }
}

TEST(FrontKernels, SubtractProducts) {
  for (const int width : kWidths) {
    TestFront front(width, 40);
    const Eigen::MatrixXd L = front.panel.middleRows(front.below_row, 40);
    const Eigen::VectorXd y = Eigen::VectorXd::LinSpaced(width, -1.0, 2.0);
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(40, 3.0, 5.0);
    Eigen::VectorXd x_out = x;
    const double* data = front.panel.data() + front.below_row;
    SubtractProduct(width, 40, data, front.stride, y.data(), x_out.data());
    EXPECT_LT((x_out - (x - L * y)).norm(), 1e-12 * (L * y).norm()) << width;
    Eigen::VectorXd y_out = y;
    SubtractTransposedProduct(width, 40, data, front.stride, x.data(), y_out.data());
    const Eigen::VectorXd expected = y - L.transpose() * x;
    EXPECT_LT((y_out - expected).norm(), 1e-12 * expected.norm()) << width;
  }
}

}  // namespace
}  // namespace ceres_ed
