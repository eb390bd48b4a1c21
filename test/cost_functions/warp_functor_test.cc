#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <cost_functions/point_to_plane_cost.h>
#include <cost_functions/point_to_point_cost.h>
#include <cost_functions/warp.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

const std::vector<Eigen::Vector3d>& NodePositions() {
  static const std::vector<Eigen::Vector3d> positions{
      {0.0, 0.0, 0.1}, {1.0, 0.2, 0.0}, {0.1, 1.0, -0.1}, {0.9, 1.1, 0.3}};
  return positions;
}

const Eigen::Vector3d kPoint(0.4, 0.6, 0.2);
constexpr double kWeights[] = {0.4, 0.3, 0.2, 0.1};

BoundPoint Bind(const Eigen::Vector3d& point) {
  return BoundPoint(
      point, 4, kWeights, [](int i) -> const Eigen::Vector3d& { return NodePositions()[i]; });
}

// Nodes that all move by x -> B x + b.
struct AffineNodes {
  AffineNodes(const Eigen::Matrix3d& B, const Eigen::Vector3d& b) {
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d& g = NodePositions()[i];
      MutableNodeAffine(values[i]) = B;
      MutableNodeTranslation(values[i]) = B * g + b - g;
      pointers[i] = values[i];
    }
  }

  double values[4][kNodeSize];
  const double* pointers[4];
};

TEST(WarpToMap, AtRestIsThePoint) {
  const AffineNodes rest(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero());
  EXPECT_LT((WarpToMap(Bind(kPoint), rest.pointers) - kPoint).norm(), 1e-15);
}

TEST(WarpToMap, IsExactUnderAnAffineMotionThatAllNodesShare) {
  Eigen::Matrix3d B;
  B << 1.2, 0.4, -0.3, 0.1, 0.8, 0.2, -0.5, 0.3, 1.1;
  const Eigen::Vector3d b(3.0, -1.0, 2.0);
  const AffineNodes nodes(B, b);
  for (const Eigen::Vector3d& point : {kPoint, NodePositions()[2], Eigen::Vector3d(5, -5, 5)}) {
    EXPECT_LT((WarpToMap(Bind(point), nodes.pointers) - (B * point + b)).norm(), 1e-14);
  }
}

TEST(WarpToMap, IsTheWeightedSumOfWhatEachNodeSays) {
  AffineNodes nodes(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero());
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < kNodeSize; ++k) nodes.values[i][k] = std::sin(1.0 + 12 * i + k);
  }
  Eigen::Vector3d expected = Eigen::Vector3d::Zero();
  for (int i = 0; i < 4; ++i) {
    const double* p = nodes.values[i];
    const Eigen::Vector3d d = kPoint - NodePositions()[i];
    for (int row = 0; row < 3; ++row) {
      expected[row] += kWeights[i] * (p[row] * d[0] + p[3 + row] * d[1] + p[6 + row] * d[2] +
                                      NodePositions()[i][row] + p[9 + row]);
    }
  }
  EXPECT_LT((WarpToMap(Bind(kPoint), nodes.pointers) - expected).norm(), 1e-15);
}

TEST(MapToCamera, IsTheRotationMatrixThenTheTranslation) {
  const Eigen::Quaterniond q(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  const Eigen::Vector3d T(0.1, 0.2, 0.3);
  const Eigen::Vector3d expected = q.toRotationMatrix() * kPoint + T;
  EXPECT_LT((MapToCamera(q.coeffs().data(), T.data(), kPoint) - expected).norm(), 1e-15);
}

TEST(PointToPointCost, IsTheDifferenceToTheTarget) {
  double residuals[3];
  ASSERT_TRUE(PointToPointCost({1.0, 2.0, 3.0})(kPoint.data(), residuals));
  EXPECT_DOUBLE_EQ(residuals[0], -0.6);
  EXPECT_DOUBLE_EQ(residuals[1], -1.4);
  EXPECT_DOUBLE_EQ(residuals[2], -2.8);
}

TEST(PointToPlaneCost, IsTheSignedDistanceToThePlane) {
  const Eigen::Vector3d normal = Eigen::Vector3d(2.0, -1.0, 2.0) / 3.0;
  double residual = 0.0;
  // (0.8 - 0.6 + 0.4) / 3 minus (2 - 2 + 6) / 3.
  ASSERT_TRUE(PointToPlaneCost({1.0, 2.0, 3.0}, normal)(kPoint.data(), &residual));
  EXPECT_NEAR(residual, 0.6 / 3.0 - 2.0, 1e-15);
  const Eigen::Vector3d above = Eigen::Vector3d(1.0, 2.0, 3.0) + 0.25 * normal;
  ASSERT_TRUE(PointToPlaneCost({1.0, 2.0, 3.0}, normal)(above.data(), &residual));
  EXPECT_NEAR(residual, 0.25, 1e-15);
}

TEST(PointToPlaneCost, IsZeroForAZeroNormal) {
  double residual = 1.0;
  ASSERT_TRUE(PointToPlaneCost({1.0, 2.0, 3.0}, Eigen::Vector3d::Zero())(kPoint.data(), &residual));
  EXPECT_EQ(residual, 0.0);
}

}  // namespace
}  // namespace ceres_ed
