#include "cost_functions/warped_point_cost.h"

#include <ceres_ed/testing/cost_evaluation.h>
#include <ceres_ed/testing/cost_laws.h>
#include <ceres_ed/util/random.h>

#include <algorithm>
#include <memory>

#include <Eigen/Geometry>
#include <cost_functions/point_to_plane_cost.h>
#include <cost_functions/point_to_point_cost.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::IsEmpty;

// Two nonlinear residuals: the pixel of a pinhole camera.
struct NonlinearCost {
  static constexpr int kNumResiduals = 2;
  template <typename T>
  bool operator()(const T* point, T* residuals) const {
    using std::exp;
    using std::sin;
    const T depth = T(5.0) + exp(T(0.1) * point[2]);
    residuals[0] = T(2.0) * point[0] / depth - T(0.3);
    residuals[1] = sin(point[1]) * point[0] / depth;
    return true;
  }
};

// A functor that can be evaluated only on one side of a plane.
struct PartialCost {
  static constexpr int kNumResiduals = 1;
  template <typename T>
  bool operator()(const T* point, T* residuals) const {
    residuals[0] = point[0];
    return point[0] > T(0.0);
  }
};

Eigen::Vector3d RandomVector(Random* random) {
  return {random->Gaussian(), random->Gaussian(), random->Gaussian()};
}

BoundPoint RandomPoint(int num_nodes, std::uint64_t seed) {
  Random random(seed);
  double weights[kMaxBoundNodes];
  Eigen::Vector3d positions[kMaxBoundNodes];
  double sum = 0.0;
  for (int i = 0; i < num_nodes; ++i) {
    weights[i] = 0.1 + random.Uniform();
    positions[i] = RandomVector(&random);
    sum += weights[i];
  }
  for (int i = 0; i < num_nodes; ++i) weights[i] /= sum;
  return BoundPoint(RandomVector(&random), num_nodes, weights, [&](int i) { return positions[i]; });
}

void NormalizeCamera(int num_nodes, bool has_camera, ParameterBlocks* blocks) {
  if (has_camera) Eigen::Map<Eigen::Vector4d>((*blocks)[num_nodes].data()).normalize();
}

ParameterBlocks RestBlocks(int num_nodes, bool has_camera) {
  ParameterBlocks blocks(num_nodes, RestNode());
  if (has_camera) {
    blocks.push_back({0.0, 0.0, 0.0, 1.0});
    blocks.push_back({0.0, 0.0, 0.0});
  }
  return blocks;
}

ParameterBlocks RandomBlocks(int num_nodes, bool has_camera, std::uint64_t seed) {
  Random random(seed);
  ParameterBlocks blocks = RestBlocks(num_nodes, has_camera);
  for (std::vector<double>& block : blocks) {
    for (double& value : block) value += 0.7 * random.Gaussian();
  }
  NormalizeCamera(num_nodes, has_camera, &blocks);
  return blocks;
}

template <int kNumNodes, typename Functor>
void ExpectCarriersAgree(const Functor& functor) {
  for (const bool has_camera : {false, true}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const BoundPoint point = RandomPoint(kNumNodes, seed);
      const WarpedPointCost<Functor> fast(functor, point, has_camera);
      const std::unique_ptr<ceres::CostFunction> plain(
          CreateAutoDiffWarpedPointCost<kNumNodes>(functor, point, has_camera));
      ASSERT_EQ(fast.num_residuals(), plain->num_residuals());
      ASSERT_EQ(fast.parameter_block_sizes(), plain->parameter_block_sizes());
      const ParameterBlocks blocks = RandomBlocks(kNumNodes, has_camera, 100 + seed);
      const std::vector<char> all(blocks.size(), 1);
      const CostEvaluation a = EvaluateCost(fast, blocks, all);
      const CostEvaluation b = EvaluateCost(*plain, blocks, all);
      ASSERT_TRUE(a.IsFinite() && b.IsFinite());
      EXPECT_LE((a.residuals - b.residuals).norm(), 1e-12 * std::max(1.0, b.residuals.norm()));
      for (std::size_t i = 0; i < blocks.size(); ++i) {
        EXPECT_LE((a.jacobians[i] - b.jacobians[i]).norm(), 1e-12 * b.jacobians[i].norm())
            << "block " << i << " of " << kNumNodes << " nodes, camera " << has_camera;
      }
    }
  }
}

template <int kNumNodes>
void ExpectCarriersAgreeOnAllFunctors() {
  ExpectCarriersAgree<kNumNodes>(PointToPointCost({0.3, -0.7, 1.1}));
  ExpectCarriersAgree<kNumNodes>(
      PointToPlaneCost({0.3, -0.7, 1.1}, Eigen::Vector3d(0.2, 0.5, -0.8).normalized()));
  ExpectCarriersAgree<kNumNodes>(NonlinearCost());
}

TEST(WarpedPointCost, EqualsPlainAutoDiffAtOneNode) { ExpectCarriersAgreeOnAllFunctors<1>(); }
TEST(WarpedPointCost, EqualsPlainAutoDiffAtTwoNodes) { ExpectCarriersAgreeOnAllFunctors<2>(); }
TEST(WarpedPointCost, EqualsPlainAutoDiffAtThreeNodes) { ExpectCarriersAgreeOnAllFunctors<3>(); }
TEST(WarpedPointCost, EqualsPlainAutoDiffAtFourNodes) { ExpectCarriersAgreeOnAllFunctors<4>(); }
TEST(WarpedPointCost, EqualsPlainAutoDiffAtEightNodes) { ExpectCarriersAgree<8>(NonlinearCost()); }

// Eight nodes and a camera are ten blocks, so there are 1,024 ways to hold some of them constant.
TEST(WarpedPointCost, ObeysTheLaws) {
  for (const bool has_camera : {false, true}) {
    for (const int num_nodes : {1, 4, 8}) {
      CostClaims claims;
      claims.rest = RestBlocks(num_nodes, has_camera);
      claims.squared_norm_at_rest.reset();
      claims.normalize = [=](ParameterBlocks* blocks) {
        NormalizeCamera(num_nodes, has_camera, blocks);
      };
      const WarpedPointCost<NonlinearCost> cost(
          NonlinearCost(), RandomPoint(num_nodes, 7), has_camera);
      EXPECT_THAT(CheckCostLaws(cost, claims), IsEmpty()) << num_nodes << " nodes";
    }
  }
}

TEST(WarpedPointCost, ObeysTheLawsWhereThePointSitsOnItsOnlyNode) {
  const Eigen::Vector3d g(0.3, 0.2, 0.1);
  const double weight = 1.0;
  const BoundPoint point(g, 1, &weight, [&](int) { return g; });
  CostClaims claims;
  claims.rest = RestBlocks(1, false);
  const WarpedPointCost<PointToPointCost> cost(PointToPointCost(g), point, false);
  EXPECT_THAT(CheckCostLaws(cost, claims), IsEmpty());
}

TEST(WarpedPointCost, PointToPlaneOfAZeroNormalObeysTheLaws) {
  CostClaims claims;
  claims.rest = RestBlocks(4, true);
  claims.normalize = [](ParameterBlocks* blocks) { NormalizeCamera(4, true, blocks); };
  const WarpedPointCost<PointToPlaneCost> cost(
      PointToPlaneCost({1.0, 2.0, 3.0}, Eigen::Vector3d::Zero()), RandomPoint(4, 3), true);
  EXPECT_THAT(CheckCostLaws(cost, claims), IsEmpty());
}

TEST(WarpedPointCost, FailsWhereItsFunctorFails) {
  const double weight = 1.0;
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  const BoundPoint point(origin, 1, &weight, [&](int) { return origin; });
  const WarpedPointCost<PartialCost> cost(PartialCost(), point, false);
  ParameterBlocks blocks = RestBlocks(1, false);
  blocks[0][kNodeTranslationOffset] = 1.0;
  EXPECT_TRUE(EvaluateResiduals(cost, blocks).evaluated);
  EXPECT_TRUE(EvaluateCost(cost, blocks, {1}).evaluated);
  blocks[0][kNodeTranslationOffset] = -1.0;
  EXPECT_FALSE(EvaluateResiduals(cost, blocks).evaluated);
  EXPECT_FALSE(EvaluateCost(cost, blocks, {1}).evaluated);
}

}  // namespace
}  // namespace ceres_ed
