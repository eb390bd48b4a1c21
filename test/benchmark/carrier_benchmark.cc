// Residuals and Jacobian of one point-to-plane cost at four nodes and a camera (54 derivatives):
// the fast carrier against plain auto-diff.
#include <array>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>
#include <cost_functions/point_to_plane_cost.h>
#include <cost_functions/warped_point_cost.h>

namespace ceres_ed {
namespace {

constexpr int kNumNodes = 4;

BoundPoint MakePoint() {
  const double weights[kNumNodes] = {0.4, 0.3, 0.2, 0.1};
  return BoundPoint({0.3, 0.4, 0.1}, kNumNodes, weights, [](int i) {
    return Eigen::Vector3d(i % 2, i / 2, 0.1 * i);
  });
}

PointToPlaneCost MakeFunctor() {
  return PointToPlaneCost({0.1, 0.2, 0.3}, Eigen::Vector3d(0.6, 0.0, 0.8));
}

void EvaluateJacobian(const ceres::CostFunction& cost, benchmark::State* state) {
  std::array<std::array<double, kNodeSize>, kNumNodes> nodes;
  std::array<std::array<double, kNodeSize>, kNumNodes + 2> jacobians;
  const double rotation[] = {0.0, 0.0, 0.6, 0.8};
  const double translation[] = {0.1, 0.2, 0.3};
  std::vector<const double*> blocks;
  for (auto& node : nodes) {
    SetNodeToRest(node.data());
    blocks.push_back(node.data());
  }
  blocks.push_back(rotation);
  blocks.push_back(translation);
  std::vector<double*> outputs;
  for (auto& jacobian : jacobians) outputs.push_back(jacobian.data());
  double residual = 0.0;
  for (auto _ : *state) {
    cost.Evaluate(blocks.data(), &residual, outputs.data());
    benchmark::DoNotOptimize(residual);
    benchmark::DoNotOptimize(jacobians);
  }
}

void FastCarrier(benchmark::State& state) {
  const WarpedPointCost<PointToPlaneCost> cost(MakeFunctor(), MakePoint(), true);
  EvaluateJacobian(cost, &state);
}
BENCHMARK(FastCarrier);

void PlainAutoDiff(benchmark::State& state) {
  const std::unique_ptr<ceres::CostFunction> cost(
      CreateAutoDiffWarpedPointCost<kNumNodes>(MakeFunctor(), MakePoint(), true));
  EvaluateJacobian(*cost, &state);
}
BENCHMARK(PlainAutoDiff);

}  // namespace
}  // namespace ceres_ed
