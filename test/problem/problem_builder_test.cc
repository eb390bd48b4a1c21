#include "ceres_ed/problem/problem_builder.h"

#include <ceres_ed/testing/residual_collection.h>

#include <algorithm>
#include <vector>

#include <ceres/solver.h>
#include <gtest/gtest.h>
#include <test/problem/strip_builder.h>

namespace ceres_ed {
namespace {

struct Counts {
  int residual_blocks;
  int parameter_blocks;
  // After Ceres has removed what is constant.
  int reduced_parameter_blocks;
  int reduced_effective_parameters;
};

void ExpectCounts(const StripBuilder& strip, const ProblemConfig& config, const Counts& expected) {
  DeformationState state(strip.problem.graph.num_nodes());
  const BuiltProblem built = strip.builder.Build(config, &state);
  EXPECT_EQ(built.problem->NumResidualBlocks(), expected.residual_blocks);
  EXPECT_EQ(built.problem->NumParameterBlocks(), expected.parameter_blocks);
  ceres::Solver::Options options;
  options.max_num_iterations = 0;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, built.problem.get(), &summary);
  // No residual in a level is constant as a whole, since such residuals were left out.
  EXPECT_EQ(summary.num_residual_blocks_reduced, expected.residual_blocks);
  EXPECT_EQ(summary.fixed_cost, 0.0);
  EXPECT_EQ(summary.num_parameter_blocks_reduced, expected.reduced_parameter_blocks);
  EXPECT_EQ(summary.num_effective_parameters_reduced, expected.reduced_effective_parameters);
}

ProblemConfig LevelOne(const StripBuilder& strip, BoundaryEdges boundary_edges, int rings) {
  return LevelOneConfig(strip.problem.graph,
                        strip.builder.PointRelevantNodes(),
                        strip.builder.has_camera(),
                        boundary_edges,
                        rings);
}

TEST(ProblemBuilder, CountsResidualsPerTerm) {
  const StripBuilder strip(HalfSeen());
  EXPECT_EQ(strip.builder.num_terms(), 3);
  EXPECT_EQ(strip.builder.NumResidualBlocks(strip.rotation), 18);
  // 5 gaps with 3 edges each along the strip and 6 columns with 2 edges each across it, in both
  // directions.
  EXPECT_EQ(strip.builder.NumResidualBlocks(strip.regularization), 2 * 5 * 3 + 2 * 6 * 2);
  EXPECT_EQ(strip.builder.NumResidualBlocks(strip.data), 4);
}

TEST(ProblemBuilder, FullProblemHasEverything) {
  const StripBuilder strip(HalfSeen());
  ExpectCounts(strip, FullConfig(18, false), {18 + 54 + 4, 18, 18, 18 * 12});
  const StripBuilder with_camera(HalfSeen(true));
  ExpectCounts(with_camera, FullConfig(18, true), {18 + 54 + 4, 20, 20, 18 * 12 + 6});
}

// With `rings`, 3 + rings columns are variable. `kKeep` has the edges in the 3 + rings gaps to the
// right (2 * 3 each) and within the columns (2 * 2 each). The next column is part of the problem
// and constant.
TEST(ProblemBuilder, LevelOneKeepsTheBoundaryEdges) {
  const StripBuilder strip(HalfSeen());
  ExpectCounts(strip, LevelOne(strip, BoundaryEdges::kKeep, 0), {9 + 30 + 4, 12, 9, 108});
  ExpectCounts(strip, LevelOne(strip, BoundaryEdges::kKeep, 1), {12 + 40 + 4, 15, 12, 144});
  ExpectCounts(strip, LevelOne(strip, BoundaryEdges::kKeep, 2), {15 + 50 + 4, 18, 15, 180});
}

TEST(ProblemBuilder, LevelOneCutsTheBoundaryEdges) {
  const StripBuilder strip(HalfSeen());
  ExpectCounts(strip, LevelOne(strip, BoundaryEdges::kCut, 0), {9 + 24 + 4, 9, 9, 108});
  ExpectCounts(strip, LevelOne(strip, BoundaryEdges::kCut, 1), {12 + 34 + 4, 12, 12, 144});
  ExpectCounts(strip, LevelOne(strip, BoundaryEdges::kCut, 2), {15 + 44 + 4, 15, 15, 180});
}

TEST(ProblemBuilder, LevelOneHasTheCamera) {
  const StripBuilder strip(HalfSeen(true));
  ExpectCounts(strip, LevelOne(strip, BoundaryEdges::kKeep, 0), {9 + 30 + 4, 14, 11, 114});
  ExpectCounts(strip, LevelOne(strip, BoundaryEdges::kCut, 0), {9 + 24 + 4, 11, 11, 114});
}

TEST(ProblemBuilder, LevelTwoHasThePointIrrelevantNodesAlone) {
  for (const bool has_camera : {false, true}) {
    const StripBuilder strip(HalfSeen(has_camera));
    ExpectCounts(strip, LevelTwoConfig(strip.builder.PointRelevantNodes()), {9 + 30, 12, 9, 108});
  }
}

TEST(ProblemBuilder, ObservationsAreNeverCut) {
  const StripBuilder strip(HalfSeen(true));
  ProblemConfig config;
  config.variable_nodes.assign(18, 0);
  config.variable_nodes[0] = 1;
  config.boundary_edges = BoundaryEdges::kCut;
  // Node 0 has its own rotation residual, no edge, and the one point of its cell, which touches
  // four nodes and the camera.
  ExpectCounts(strip, config, {1 + 0 + 1, 6, 1, 12});
}

TEST(ProblemBuilder, CutTakesOutExactlyTheEdgesAcrossTheBoundary) {
  const StripBuilder strip(HalfSeen());
  const std::vector<char> relevant = strip.builder.PointRelevantNodes();
  for (const BoundaryEdges boundary_edges : {BoundaryEdges::kKeep, BoundaryEdges::kCut}) {
    int across = 0;
    for (const SelectedResidual& residual :
         strip.builder.Select(LevelOne(strip, boundary_edges, 0))) {
      if (residual.term != strip.regularization) continue;
      across += relevant[residual.blocks[0].node] != relevant[residual.blocks[1].node];
    }
    EXPECT_EQ(across, boundary_edges == BoundaryEdges::kKeep ? 6 : 0);
  }
}

TEST(ProblemBuilder, NodesThatObservationsTouchArePointRelevant) {
  StripBuilder strip(HalfSeen());
  std::vector<char> expected(18, 0);
  std::fill_n(expected.begin(), 9, 1);
  EXPECT_EQ(strip.builder.PointRelevantNodes(), expected);
  strip.builder.SetWeight(strip.data, 0.0);
  EXPECT_EQ(strip.builder.PointRelevantNodes(), std::vector<char>(18, 0));
}

TEST(ProblemBuilder, AnObservationWithoutWeightIsNotThere) {
  StripBuilder strip(HalfSeen());
  // Points 2 and 3 are in the second column of cells.
  strip.problem.correspondences[2].weight = 0.0;
  strip.problem.correspondences[3].weight = 0.0;
  strip.builder.CollectResiduals(
      strip.data, **strip.registry.Create("point_to_point", {}), strip.problem.Context());
  std::vector<char> expected(18, 0);
  std::fill_n(expected.begin(), 6, 1);
  EXPECT_EQ(strip.builder.PointRelevantNodes(), expected);
  ExpectCounts(strip, FullConfig(18, false), {18 + 54 + 2, 18, 18, 216});
}

TEST(ProblemBuilder, ATermWithoutWeightIsLeftOut) {
  StripBuilder strip(HalfSeen());
  strip.builder.SetWeight(strip.regularization, 0.0);
  ExpectCounts(strip, FullConfig(18, false), {18 + 4, 18, 18, 216});
  EXPECT_EQ(strip.builder.Evaluate(RandomState(strip.problem, 0.3, 1)).terms[1].weighted, 0.0);
  EXPECT_GT(strip.builder.Evaluate(RandomState(strip.problem, 0.3, 1)).terms[1].raw, 0.0);
}

TEST(ProblemBuilder, CollectingAnewReplacesTheResiduals) {
  StripBuilder strip(HalfSeen());
  strip.problem.correspondences.resize(1);
  strip.builder.CollectResiduals(
      strip.data, **strip.registry.Create("point_to_point", {}), strip.problem.Context());
  EXPECT_EQ(strip.builder.NumResidualBlocks(strip.data), 1);
  ExpectCounts(strip, FullConfig(18, false), {18 + 54 + 1, 18, 18, 216});
}

TEST(ProblemBuilder, HeldBlocksComeBackBitEqual) {
  const StripBuilder strip(HalfSeen(true));
  const DeformationState start = RandomState(strip.problem, 0.1, 3);
  const ProblemConfig configs[] = {LevelOne(strip, BoundaryEdges::kKeep, 0),
                                   LevelOne(strip, BoundaryEdges::kCut, 1),
                                   LevelTwoConfig(strip.builder.PointRelevantNodes())};
  for (const ProblemConfig& config : configs) {
    DeformationState state = start;
    const BuiltProblem built = strip.builder.Build(config, &state);
    ceres::Solver::Options options;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, built.problem.get(), &summary);
    ASSERT_LT(summary.final_cost, summary.initial_cost);
    const std::vector<double> before = AllParameters(start);
    const std::vector<double> after = AllParameters(state);
    for (int j = 0; j < 18; ++j) {
      const bool same =
          std::equal(&before[j * kNodeSize], &before[(j + 1) * kNodeSize], &after[j * kNodeSize]);
      EXPECT_EQ(same, config.variable_nodes[j] == 0) << "node " << j;
    }
    const bool same_camera =
        std::equal(before.begin() + 18 * kNodeSize, before.end(), after.begin() + 18 * kNodeSize);
    EXPECT_EQ(same_camera, !config.camera_variable);
    EXPECT_NEAR(state.camera_from_map.rotation.norm(), 1.0, 1e-12);
  }
}

TEST(ProblemBuilder, EvaluateEqualsCeres) {
  for (const LossType type : {LossType::kSquared, LossType::kHuber, LossType::kWelsch}) {
    StripBuilder strip(HalfSeen(true), "point_to_plane");
    strip.problem.correspondences[1].weight = 0.3;
    strip.builder.CollectResiduals(
        strip.data, **strip.registry.Create("point_to_plane", {}), strip.problem.Context());
    strip.builder.SetLoss(strip.data, {type, 0.05});
    strip.builder.SetLoss(strip.regularization, {type, 0.2});
    DeformationState state = RandomState(strip.problem, 0.2, 9);
    const BuiltProblem built = strip.builder.Build(FullConfig(18, true), &state);
    double cost = 0.0;
    ASSERT_TRUE(built.problem->Evaluate({}, &cost, nullptr, nullptr, nullptr));
    EXPECT_NEAR(strip.builder.Evaluate(state).Total(), cost, 1e-13 * cost);
  }
}

TEST(ProblemBuilder, WeightedIsWeightTimesRawForTheSquaredLoss) {
  const StripBuilder strip(HalfSeen());
  const EnergySummary summary = strip.builder.Evaluate(RandomState(strip.problem, 0.2, 4));
  const double weights[] = {1.5, 2.5, 3.5};
  const int residuals[] = {6 * 18, 3 * 54, 3 * 4};
  ASSERT_EQ(summary.terms.size(), 3u);
  for (int t = 0; t < 3; ++t) {
    EXPECT_GT(summary.terms[t].raw, 0.0);
    EXPECT_NEAR(summary.terms[t].weighted, weights[t] * summary.terms[t].raw, 1e-13);
    EXPECT_EQ(summary.terms[t].residuals, residuals[t]);
  }
  EXPECT_EQ(summary.terms[0].label, "rotation");
}

TEST(ProblemBuilder, LossesActOnTheSquaredNormOfEachResidualBlock) {
  StripBuilder strip(HalfSeen());
  constexpr double kWidth = 0.07;
  strip.builder.SetLoss(strip.data, {LossType::kGemanMcClure, kWidth});
  const DeformationState rest(18);
  double expected = 0.0;
  double raw = 0.0;
  for (const Correspondence& c : strip.problem.correspondences) {
    const double s = (strip.problem.points[c.point] - c.target).squaredNorm();
    expected += 0.5 * 3.5 * kWidth * kWidth * s / (kWidth * kWidth + s);
    raw += 0.5 * s;
  }
  const TermEnergy energy = strip.builder.Evaluate(rest).terms[strip.data];
  EXPECT_NEAR(energy.weighted, expected, 1e-14);
  EXPECT_NEAR(energy.raw, raw, 1e-14);
}

}  // namespace
}  // namespace ceres_ed
