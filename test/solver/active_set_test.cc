// Level I by information: what it costs to hold a node, and the set of nodes that is moved.
#include "ceres_ed/solver/decoupling/active_set.h"

#include <ceres_ed/solver/decoupling/frontier.h>
#include <ceres_ed/solver/decoupling/information_loss.h>
#include <ceres_ed/solver/strategy.h>

#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/problem/strip_builder.h>
#include <test/solver/assembly.h>

namespace ceres_ed {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kColumns = 10;
constexpr int kRows = 3;

// A strip whose first three columns of nodes are PR.
TestProblemOptions LongStrip() {
  TestProblemOptions options = HalfSeen(/*has_camera=*/false, /*points_per_cell=*/4);
  options.columns = kColumns;
  options.rows = kRows;
  return options;
}

// The PR nodes of a strip at rest have moved.
struct PushedStrip {
  PushedStrip() : strip(LongStrip()), before(RandomState(strip.problem, 0.02, 4)), after(before) {
    const DeformationState moved = RandomState(strip.problem, 0.1, 5);
    observed = strip.builder.PointRelevantNodes();
    for (int j = 0; j < after.num_nodes(); ++j) {
      if (observed[j] != 0) std::copy_n(moved.node(j), kNodeSize, after.node(j));
      hidden.push_back(observed[j] != 0 ? 0 : 1);
    }
  }

  // Returns H of the hidden nodes, and the change of their gradient, by dense matrices.
  Assembled Dense() const {
    ProblemConfig config;
    config.variable_nodes = hidden;
    Assembled dense = AssembleInBlocks(strip.builder, config, after, 1);
    dense.gradient -= AssembleInBlocks(strip.builder, config, before, 1).gradient;
    return dense;
  }

  Frontier Evaluated() const {
    Frontier frontier;
    EXPECT_TRUE(frontier.Evaluate(strip.builder, hidden, before, after, 1));
    return frontier;
  }

  StripBuilder strip;
  DeformationState before;
  DeformationState after;
  std::vector<char> observed;
  std::vector<char> hidden;
};

double LossOf(const Eigen::MatrixXd& H, const Eigen::VectorXd& g) {
  return 0.5 * g.dot(H.ldlt().solve(g));
}

TEST(Frontier, DecrementIsWhatANodeLosesAlone) {
  const PushedStrip pushed;
  const Assembled dense = pushed.Dense();
  const Frontier frontier = pushed.Evaluated();
  ASSERT_EQ(frontier.nodes().size(), static_cast<std::size_t>((kColumns - 3) * kRows));
  for (int i = 0; i < static_cast<int>(frontier.nodes().size()); ++i) {
    const Eigen::MatrixXd H = dense.H.block(12 * i, 12 * i, 12, 12);
    const double expected = LossOf(H, dense.gradient.segment(12 * i, 12));
    EXPECT_NEAR(frontier.Decrement(i), expected, 1e-6 * expected) << i;
    // Only neighbours of PR nodes feel a force.
    EXPECT_EQ(frontier.Decrement(i) > 0.0, i < kRows) << i;
  }
}

// The eigenvalues of D^-1/2 H D^-1/2 with the diagonal blocks D of H.
Eigen::VectorXd EigenvaluesInBlocks(const Eigen::MatrixXd& H) {
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(H.rows(), H.cols());
  for (Eigen::Index i = 0; i < H.rows(); i += 12) D.block(i, i, 12, 12) = H.block(i, i, 12, 12);
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(H, D).eigenvalues();
}

TEST(Frontier, SumOfDecrementsBoundsTheLoss) {
  const PushedStrip pushed;
  const Assembled dense = pushed.Dense();
  const double sum = pushed.Evaluated().Search(kInfinity).decrement;
  const Eigen::VectorXd eigenvalues = EigenvaluesInBlocks(dense.H);
  const double loss = LossOf(dense.H, dense.gradient);
  EXPECT_GE(loss, (1.0 - 1e-6) * sum / eigenvalues.maxCoeff());
  EXPECT_LE(loss, (1.0 + 1e-6) * sum / eigenvalues.minCoeff());
  EXPECT_GT(loss, sum / 3.0);
}

TEST(Frontier, SearchEndsWhereTheRestIsSmallEnough) {
  const PushedStrip pushed;
  const Frontier frontier = pushed.Evaluated();
  const FrontierSearch none = frontier.Search(kInfinity);
  EXPECT_TRUE(none.released.empty());
  EXPECT_EQ(none.left, none.decrement);
  EXPECT_EQ(none.num_pushed, kRows);
  // Without a budget the force reaches every node.
  const FrontierSearch all = frontier.Search(0.0);
  EXPECT_EQ(all.released.size(), frontier.nodes().size());
  EXPECT_EQ(all.left, 0.0);
  std::size_t fewer = 0;
  for (const double share : {0.5, 0.1, 0.01, 1e-3}) {
    const double budget = share * none.decrement;
    const FrontierSearch search = frontier.Search(budget);
    EXPECT_LE(search.left, budget);
    EXPECT_GE(search.released.size(), fewer) << share;
    fewer = search.released.size();
    // The same nodes are found first.
    for (std::size_t k = 0; k < search.released.size(); ++k) {
      EXPECT_EQ(search.released[k].place, all.released[k].place);
    }
  }
  EXPECT_GT(fewer, static_cast<std::size_t>(kRows));
}

// The loss of a solve that holds what the search leaves, on the quadratic problem.
TEST(Frontier, SearchPredictsWhatHoldingTheRestLoses) {
  const PushedStrip pushed;
  const Assembled dense = pushed.Dense();
  const Frontier frontier = pushed.Evaluated();
  const double whole = LossOf(dense.H, dense.gradient);
  const double least = EigenvaluesInBlocks(dense.H).minCoeff();
  double more = whole;
  for (const double share : {0.3, 0.03, 0.003, 1e-4}) {
    const double budget = share * frontier.Search(kInfinity).decrement;
    const FrontierSearch search = frontier.Search(budget);
    std::vector<Eigen::Index> rows;
    double gain = 0.0;
    for (const ReleasedNode& node : search.released) {
      for (int r = 0; r < 12; ++r) rows.push_back(12 * node.place + r);
      gain += node.gain;
    }
    const double gained = LossOf(dense.H(rows, rows), dense.gradient(rows));
    const double lost = whole - gained;
    EXPECT_LT(lost, more) << share;
    EXPECT_LT(lost, budget / least) << share;
    // The steps of the search are part of a solve of the set, and all but its end.
    EXPECT_LE(gain, gained * (1.0 + 1e-9)) << share;
    EXPECT_GE(gain, gained - budget / least) << share;
    more = lost;
  }
}

TEST(Frontier, HasNoNodesWithoutResiduals) {
  const PushedStrip pushed;
  Frontier frontier;
  const std::vector<char> none(pushed.hidden.size(), 0);
  ASSERT_TRUE(frontier.Evaluate(pushed.strip.builder, none, pushed.before, pushed.after, 1));
  EXPECT_TRUE(frontier.nodes().empty());
  EXPECT_TRUE(frontier.Search(0.0).released.empty());
}

double LogDeterminant(const Eigen::MatrixXd& H, const std::vector<Eigen::Index>& rows) {
  if (rows.empty()) return 0.0;
  const Eigen::MatrixXd part = H(rows, rows);
  return 2.0 * Eigen::MatrixXd(part.llt().matrixL()).diagonal().array().log().sum();
}

TEST(InformationLoss, EqualsTheDenseDivergence) {
  for (const bool has_camera : {false, true}) {
    const TestProblem problem = MakeProblem(has_camera);
    const auto builder = MakeBuilder(problem, {});
    const DeformationState state = RandomState(problem, 0.05, 3);
    const int num_nodes = state.num_nodes();
    const std::vector<char> observed = builder->PointRelevantNodes();
    const Eigen::MatrixXd H =
        AssembleInBlocks(*builder, FullConfig(num_nodes, has_camera), state, 1).H;
    double more = kInfinity;
    for (const int rings : {0, 1, 2}) {
      const std::vector<char> moved =
          LevelOneConfig(problem.graph, observed, has_camera, BoundaryEdges::kKeep, rings)
              .variable_nodes;
      std::vector<Eigen::Index> c, a, h;
      for (Eigen::Index r = 0; r < H.rows(); ++r) {
        const int node = static_cast<int>(r / 12);
        const bool is_seen = node >= num_nodes || observed[node] != 0;
        (is_seen ? c : moved[node] != 0 ? a : h).push_back(r);
      }
      // The entropy of the observed nodes, with the held ones known or not.
      std::vector<Eigen::Index> ca = c, ah = a;
      ca.insert(ca.end(), a.begin(), a.end());
      ah.insert(ah.end(), h.begin(), h.end());
      const auto precision = [&](const std::vector<Eigen::Index>& others) {
        Eigen::MatrixXd result = H(c, c);
        if (!others.empty()) {
          result -= H(c, others) * H(others, others).llt().solve(Eigen::MatrixXd(H(others, c)));
        }
        return result;
      };
      std::vector<Eigen::Index> all(c.size());
      for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<Eigen::Index>(k);
      const double expected =
          0.5 * (LogDeterminant(precision(a), all) - LogDeterminant(precision(ah), all));
      const StatusOr<double> found = MeasureInformationLoss(*builder, observed, moved, state, 1);
      ASSERT_TRUE(found.ok()) << found.status().message();
      EXPECT_NEAR(*found, expected, 1e-4 * expected) << rings;
      EXPECT_LT(*found, more) << rings;
      more = *found;
    }
    const std::vector<char> all(num_nodes, 1);
    EXPECT_NEAR(*MeasureInformationLoss(*builder, observed, all, state, 1), 0.0, 1e-8);
  }
}

StrategyOptions ByInformation(double bound) {
  StrategyOptions options;
  options.mode = SolveMode::kTwoLevel;
  options.active = ActiveSetRule::kInformation;
  options.active_bound = bound;
  return options;
}

SolverOptions Tight() {
  SolverOptions options;
  options.max_iterations = 200;
  options.function_tolerance = 1e-15;
  options.parameter_tolerance = 1e-14;
  return options;
}

TEST(ActiveSet, WithoutABoundEqualsNoRings) {
  const StripBuilder strip(LongStrip());
  const DeformationState start = RandomState(strip.problem, 0.1, 8);
  DeformationState found = start;
  DeformationState expected = start;
  StrategyOptions rings;
  rings.mode = SolveMode::kTwoLevel;
  rings.rings = 0;
  MakeStrategy(rings)->Solve(strip.builder, {}, &expected);
  const SolveSummary summary =
      MakeStrategy(ByInformation(kInfinity))->Solve(strip.builder, {}, &found);
  EXPECT_EQ(AllParameters(found), AllParameters(expected));
  EXPECT_TRUE(summary.active_set.hidden_nodes.empty());
  EXPECT_GT(summary.active_set.held_share, 0.0);
}

TEST(ActiveSet, WithABoundOfZeroEqualsBatch) {
  const StripBuilder strip(LongStrip());
  const DeformationState start = RandomState(strip.problem, 0.1, 8);
  DeformationState found = start;
  DeformationState expected = start;
  const SolveSummary batch =
      MakeStrategy(StrategyOptions())->Solve(strip.builder, Tight(), &expected);
  const SolveSummary summary =
      MakeStrategy(ByInformation(0.0))->Solve(strip.builder, Tight(), &found);
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  EXPECT_EQ(summary.active_set.hidden_nodes.size(),
            static_cast<std::size_t>((kColumns - 3) * kRows));
  EXPECT_NEAR(summary.final_energy, batch.final_energy, 1e-10 * batch.final_energy);
}

TEST(ActiveSet, LosesLessWithASmallerBound) {
  const StripBuilder strip(LongStrip());
  const DeformationState start(strip.problem.graph.num_nodes());
  DeformationState state = start;
  const double batch =
      MakeStrategy(StrategyOptions())->Solve(strip.builder, Tight(), &state).final_energy;
  double more = kInfinity;
  std::size_t fewer = 0;
  for (const double bound : {1e9, 1e-2, 1e-4, 1e-6}) {
    state = start;
    const SolveSummary summary =
        MakeStrategy(ByInformation(bound))->Solve(strip.builder, Tight(), &state);
    EXPECT_LE(summary.final_energy, more * (1.0 + 1e-9)) << bound;
    EXPECT_GE(summary.active_set.hidden_nodes.size(), fewer) << bound;
    EXPECT_LE(summary.active_set.held_share, bound) << bound;
    EXPECT_GE(summary.final_energy, batch * (1.0 - 1e-9));
    more = summary.final_energy;
    fewer = summary.active_set.hidden_nodes.size();
  }
  EXPECT_LT(more, batch * (1.0 + 1e-3));
}

TEST(ActiveSet, IsTheSameAtAnyNumberOfThreads) {
  const StripBuilder strip(LongStrip());
  const DeformationState start = RandomState(strip.problem, 0.1, 8);
  std::vector<double> expected;
  for (const int threads : {1, 3}) {
    SolverOptions options;
    options.num_threads = threads;
    DeformationState state = start;
    const SolveSummary summary =
        MakeStrategy(ByInformation(1e-3))->Solve(strip.builder, options, &state);
    EXPECT_FALSE(summary.active_set.hidden_nodes.empty());
    if (threads == 1) expected = AllParameters(state);
    EXPECT_EQ(AllParameters(state), expected);
  }
}

SolvedLevelOne LevelOf(const PushedStrip& pushed) {
  SolvedLevelOne level;
  level.builder = &pushed.strip.builder;
  level.moved_hidden.assign(pushed.hidden.size(), 0);
  level.candidates = pushed.hidden;
  level.before = &pushed.before;
  level.after = &pushed.after;
  level.energy = 1.0;
  return level;
}

TEST(ActiveSet, TakesWhatANewFrameChoosesAlone) {
  PushedStrip pushed;
  ActiveSet set(1e-3);
  const int first = set.Look(LevelOf(pushed));
  EXPECT_GT(first, 0);
  EXPECT_EQ(set.nodes().size(), first);
  EXPECT_TRUE(set.moves_unjudged());
  // Nothing moves any more. Within a frame the set stays; the next frame chooses anew.
  pushed.after = pushed.before;
  EXPECT_EQ(set.Look(LevelOf(pushed)), 0);
  EXPECT_EQ(set.nodes().size(), first);
  set.BeginFrame();
  EXPECT_EQ(set.nodes().size(), first);
  set.Look(LevelOf(pushed));
  EXPECT_TRUE(set.nodes().empty());
  EXPECT_FALSE(set.moves_unjudged());
}

TEST(ActiveSet, HasTheNamesOfAWindow) {
  const PushedStrip pushed;
  std::vector<int> names;
  for (std::size_t j = 0; j < pushed.hidden.size(); ++j)
    names.push_back(static_cast<int>(1000 + j));
  SolvedLevelOne level = LevelOf(pushed);
  ActiveSet plain(1e-3);
  plain.Look(level);
  level.names = &names;
  ActiveSet named(1e-3);
  named.Look(level);
  ASSERT_EQ(named.nodes().size(), plain.nodes().size());
  for (int k = 0; k < plain.nodes().size(); ++k) {
    EXPECT_EQ(named.nodes().nodes()[k], plain.nodes().nodes()[k] + 1000);
  }
  EXPECT_TRUE(named.IsJudged(1000 + kColumns * kRows - 1));
  EXPECT_FALSE(named.IsJudged(1000));
}

TEST(ActiveSet, LoadsWhatItSaved) {
  const PushedStrip pushed;
  ActiveSet set(1e-3);
  set.Look(LevelOf(pushed));
  ActiveSet other(1e-3);
  other.Load(set.Save());
  EXPECT_EQ(other.nodes().nodes(), set.nodes().nodes());
  EXPECT_EQ(other.Save().judged, set.Save().judged);
  EXPECT_EQ(other.moves_unjudged(), set.moves_unjudged());
  // A file may hold anything.
  other.Load({{-5, 3}, {-1}, 0});
  EXPECT_THAT(other.nodes().nodes(), ::testing::ElementsAre(3));
}

}  // namespace
}  // namespace ceres_ed
