#include "cost_functions/pose_prior_cost.h"

#include <ceres_ed/testing/cost_evaluation.h>
#include <ceres_ed/testing/cost_laws.h>

#include <cmath>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::IsEmpty;

using Matrix6 = Eigen::Matrix<double, 6, 6>;

Eigen::Quaterniond PriorRotation() {
  return Eigen::Quaterniond(Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.2, 1.0, -0.4).normalized()));
}
Eigen::Vector3d PriorTranslation() { return {0.3, -1.0, 2.0}; }

Matrix6 ExampleSqrtInformation() {
  Matrix6 U = Matrix6::Zero();
  for (int r = 0; r < 6; ++r) {
    for (int c = r; c < 6; ++c) U(r, c) = 1.0 + 0.3 * r - 0.2 * c;
  }
  return U;
}

ParameterBlocks Pose(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation) {
  return {CopyBlock(rotation.coeffs().data(), 4), CopyBlock(translation.data(), 3)};
}

TEST(PosePriorCost, ObeysTheLaws) {
  const std::unique_ptr<ceres::CostFunction> cost(
      PosePriorCost::Create(PriorRotation(), PriorTranslation(), ExampleSqrtInformation()));
  CostClaims claims;
  claims.rest = Pose(PriorRotation(), PriorTranslation());
  claims.normalize = [](ParameterBlocks* blocks) {
    Eigen::Map<Eigen::Vector4d>((*blocks)[0].data()).normalize();
  };
  claims.invariances.push_back({"a change of the quaternion's sign", [](ParameterBlocks* blocks) {
                                  for (double& q : (*blocks)[0]) q = -q;
                                }});
  // Half a turn away from the prior, where the sign of the quaternion changes.
  claims.degenerate.push_back(
      Pose(PriorRotation() * Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0), PriorTranslation()));
  EXPECT_THAT(CheckCostLaws(*cost, claims), IsEmpty());
}

TEST(PosePriorCost, IsTwiceTheSineOfHalfTheAngleAboutTheAxis) {
  const std::unique_ptr<ceres::CostFunction> cost(
      PosePriorCost::Create(PriorRotation(), PriorTranslation(), Matrix6::Identity()));
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, 2.0, -2.0) / 3.0;
  const Eigen::Vector3d shift(0.01, 0.02, -0.03);
  for (const double angle : {1e-6, 0.3, 1.5, 3.1}) {
    for (const double sign : {1.0, -1.0}) {
      Eigen::Quaterniond rotation =
          PriorRotation() * Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
      rotation.coeffs() *= sign;
      const Eigen::VectorXd residuals =
          EvaluateResiduals(*cost, Pose(rotation, PriorTranslation() + shift)).residuals;
      EXPECT_LT((residuals.head<3>() - 2.0 * std::sin(angle / 2.0) * axis).norm(), 1e-14);
      EXPECT_LT((residuals.tail<3>() - shift).norm(), 1e-14);
    }
  }
}

TEST(PosePriorCost, IsMultipliedByTheSquareRootOfTheInformation) {
  const Matrix6 U = ExampleSqrtInformation();
  const std::unique_ptr<ceres::CostFunction> plain(
      PosePriorCost::Create(PriorRotation(), PriorTranslation(), Matrix6::Identity()));
  const std::unique_ptr<ceres::CostFunction> weighted(
      PosePriorCost::Create(PriorRotation(), PriorTranslation(), U));
  const ParameterBlocks pose = Pose(Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {1.0, 2.0, 3.0});
  const Eigen::VectorXd expected = U * EvaluateResiduals(*plain, pose).residuals;
  EXPECT_LT((EvaluateResiduals(*weighted, pose).residuals - expected).norm(), 1e-14);
}

}  // namespace
}  // namespace ceres_ed
