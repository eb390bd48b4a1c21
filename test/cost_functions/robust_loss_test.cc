#include "cost_functions/robust_loss.h"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

constexpr double kWidth = 0.4;
constexpr double kSquaredWidth = kWidth * kWidth;

struct NamedLoss {
  std::string name;
  std::shared_ptr<ceres::LossFunction> loss;
};

std::vector<NamedLoss> Losses() {
  return {{"Welsch", std::make_shared<WelschLoss>(kWidth)},
          {"Geman-McClure", std::make_shared<GemanMcClureLoss>(kWidth)}};
}

double Rho(const ceres::LossFunction& loss, double s, int derivative) {
  double rho[3];
  loss.Evaluate(s, rho);
  return rho[derivative];
}

TEST(RobustLoss, DerivativesEqualNumericDifferences) {
  for (const NamedLoss& named : Losses()) {
    for (const double s : {0.01, 0.1, kSquaredWidth, 0.5, 2.0}) {
      const double h = 1e-4 * s;
      for (const int derivative : {1, 2}) {
        // The formula is of fourth order, so its error is about h^4 / s^4 = 1e-16.
        const double numeric = (8.0 * (Rho(*named.loss, s + h, derivative - 1) -
                                       Rho(*named.loss, s - h, derivative - 1)) -
                                (Rho(*named.loss, s + 2.0 * h, derivative - 1) -
                                 Rho(*named.loss, s - 2.0 * h, derivative - 1))) /
                               (12.0 * h);
        EXPECT_NEAR(Rho(*named.loss, s, derivative), numeric, 1e-9)
            << named.name << ", s = " << s << ", derivative " << derivative;
      }
    }
  }
}

TEST(RobustLoss, IsTheSquaredNormForSmallResiduals) {
  for (const NamedLoss& named : Losses()) {
    EXPECT_EQ(Rho(*named.loss, 0.0, 0), 0.0) << named.name;
    EXPECT_EQ(Rho(*named.loss, 0.0, 1), 1.0) << named.name;
    EXPECT_NEAR(Rho(*named.loss, 1e-8, 0), 1e-8, 1e-15) << named.name;
  }
}

TEST(RobustLoss, SaturatesAtTheSquaredWidth) {
  for (const NamedLoss& named : Losses()) {
    EXPECT_NEAR(Rho(*named.loss, 1e12, 0), kSquaredWidth, 1e-12) << named.name;
    EXPECT_NEAR(Rho(*named.loss, 1e12, 1), 0.0, 1e-12) << named.name;
    EXPECT_NEAR(Rho(*named.loss, 1e12, 2), 0.0, 1e-12) << named.name;
  }
}

TEST(RobustLoss, HasTheStatedForm) {
  // At s = a^2: a^2 (1 - 1 / e), and a^2 / 2.
  EXPECT_NEAR(
      Rho(WelschLoss(kWidth), kSquaredWidth, 0), kSquaredWidth * (1.0 - std::exp(-1.0)), 1e-15);
  EXPECT_NEAR(Rho(GemanMcClureLoss(kWidth), kSquaredWidth, 0), 0.5 * kSquaredWidth, 1e-15);
}

TEST(RobustLoss, NeverPullsHarderThanTheSquaredLoss) {
  for (const NamedLoss& named : Losses()) {
    for (double s = 0.0; s < 10.0; s += 0.01) {
      EXPECT_LE(Rho(*named.loss, s, 1), 1.0) << named.name;
      EXPECT_GE(Rho(*named.loss, s, 1), 0.0) << named.name;
      EXPECT_LE(Rho(*named.loss, s, 2), 0.0) << named.name;
    }
  }
}

}  // namespace
}  // namespace ceres_ed
