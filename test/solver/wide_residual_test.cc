// Tests residuals on many nodes at once, to which the normal equations give dual unknowns.
#include <ceres_ed/energy/custom_energy.h>
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>
#include <ceres_ed/solver/strategy.h>
#include <ceres_ed/testing/residual_collection.h>

#include <cmath>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <ceres/cost_function.h>
#include <gtest/gtest.h>
#include <test/problem/strip_builder.h>
#include <test/solver/assembly.h>

namespace ceres_ed {
namespace {

constexpr int kNumResiduals = 4;

// r = |x|^2 a + B x - c over all parameters x of the nodes and the camera, where B has no
// structure.
class WideCost final : public ceres::CostFunction {
 public:
  WideCost(int num_nodes, bool has_camera) {
    set_num_residuals(kNumResiduals);
    mutable_parameter_block_sizes()->assign(num_nodes, kNodeSize);
    if (has_camera) {
      mutable_parameter_block_sizes()->push_back(kRotationSize);
      mutable_parameter_block_sizes()->push_back(kTranslationSize);
    }
    int size = 0;
    for (const int block : parameter_block_sizes()) size += block;
    for (int i = 0; i < size; ++i) {
      for (int r = 0; r < kNumResiduals; ++r) B_.push_back(std::sin(1.0 + 37.0 * i + 5.0 * r));
    }
  }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    for (int r = 0; r < kNumResiduals; ++r) residuals[r] = -3.0;
    int column = 0;
    for (std::size_t b = 0; b < parameter_block_sizes().size(); ++b) {
      const int size = parameter_block_sizes()[b];
      for (int i = 0; i < size; ++i, ++column) {
        const double x = parameters[b][i];
        for (int r = 0; r < kNumResiduals; ++r) {
          const double slope = B_[kNumResiduals * column + r];
          residuals[r] += 0.01 * (r + 1) * x * x + slope * x;
          if (jacobians != nullptr && jacobians[b] != nullptr) {
            jacobians[b][r * size + i] = 0.02 * (r + 1) * x + slope;
          }
        }
      }
    }
    return true;
  }

 private:
  std::vector<double> B_;
};

struct WideProblem {
  explicit WideProblem(bool has_camera, const LossSpec& loss = {})
      : problem(MakeTestProblem(Options(has_camera))), builder(problem.graph, has_camera) {
    const auto wide =
        MakeEnergy(EnergyKind::kPrior, [](const EnergyContext& context, ResidualSink* sink) {
          const int num_nodes = context.graph->num_nodes();
          std::vector<BlockRef> blocks;
          for (int j = 0; j < num_nodes; ++j) blocks.push_back(BlockRef::Node(j));
          if (context.has_camera) {
            blocks.push_back(BlockRef::CameraRotation());
            blocks.push_back(BlockRef::CameraTranslation());
          }
          sink->Add(std::make_unique<WideCost>(num_nodes, context.has_camera),
                    blocks.data(),
                    static_cast<int>(blocks.size()));
        });
    for (const char* name : {"rotation", "regularization", "node_prior", "pose_prior"}) {
      Add(name, **registry.Create(name, {}), {});
    }
    Add("wide", *wide, loss);
  }

  static TestProblemOptions Options(bool has_camera) {
    TestProblemOptions options;
    options.columns = 10;
    options.rows = 4;
    options.has_camera = has_camera;
    return options;
  }

  void Add(const char* name, const EnergyTerm& term, const LossSpec& loss) {
    builder.CollectResiduals(
        builder.AddTerm(name, term.kind(), 1.0, loss), term, problem.Context());
  }

  TestProblem problem;
  EnergyRegistry registry = BuiltinEnergies();
  ProblemBuilder builder;
};

TEST(WideResidual, LeavesTheEquationsAsTheyAreOnceItsUnknownsAreEliminated) {
  for (const bool has_camera : {false, true}) {
    WideProblem wide(has_camera, {LossType::kHuber, 0.5});
    const ProblemConfig config = FullConfig(wide.problem.graph.num_nodes(), has_camera);
    DeformationState state = RandomState(wide.problem, 0.1, 5);
    NormalEquations equations;
    equations.Build(wide.builder, config, DualResiduals::kWhereTheyPay);
    ASSERT_EQ(equations.num_dual(), 2);
    const BlockStructure structure(
        equations.BlockSizes(), equations.BlockPairs(), equations.num_dual());
    ASSERT_TRUE(equations.SetStructure(&structure));
    Assembled blocks;
    std::vector<double> values;
    ASSERT_TRUE(equations.Evaluate(state, 2, &blocks.cost, &values, &blocks.gradient));
    const Eigen::Index n = structure.num_primal_rows();
    const Eigen::Index num_dual = structure.num_rows() - n;
    const Eigen::MatrixXd K = DenseOf(structure, values);
    EXPECT_EQ(K.bottomRightCorner(num_dual, num_dual),
              -Eigen::MatrixXd::Identity(num_dual, num_dual));
    const Eigen::MatrixXd J = K.bottomLeftCorner(num_dual, n);
    blocks.H = K.topLeftCorner(n, n) + J.transpose() * J;
    blocks.gradient.conservativeResize(n);
    ExpectClose(blocks, AssembleWithCeres(wide.builder, config, &state));
  }
}

TEST(WideResidual, LeavesNodesApartThatShareNothingElse) {
  const WideProblem wide(/*has_camera=*/true);
  NormalEquations equations;
  const ProblemConfig config = FullConfig(wide.problem.graph.num_nodes(), true);
  equations.Build(wide.builder, config, DualResiduals::kWhereTheyPay);
  const int num_nodes = wide.problem.graph.num_nodes();
  int num_node_pairs = 0;
  for (const BlockPair& pair : equations.BlockPairs()) {
    if (pair.row < num_nodes) ++num_node_pairs;
  }
  // Counts one of the two directed edges between neighbours.
  EXPECT_EQ(num_node_pairs, wide.problem.graph.num_edges() / 2);
}

TEST(WideResidual, HasTheMinimumOfCeres) {
  for (const bool has_camera : {false, true}) {
    const WideProblem wide(has_camera, {LossType::kHuber, 0.5});
    double energies[2];
    for (const LinearSolver linear_solver : {LinearSolver::kCeres, LinearSolver::kBlock}) {
      StrategyOptions strategy;
      strategy.linear_solver = linear_solver;
      SolverOptions options;
      options.max_iterations = 200;
      options.function_tolerance = 1e-14;
      DeformationState state(wide.problem.graph.num_nodes());
      const SolveSummary summary = MakeStrategy(strategy)->Solve(wide.builder, options, &state);
      ASSERT_TRUE(summary.IsUsable()) << summary.message;
      EXPECT_LT(summary.final_energy, 0.9 * summary.initial_energy);
      energies[linear_solver == LinearSolver::kBlock ? 1 : 0] = summary.final_energy;
    }
    EXPECT_NEAR(energies[0], energies[1], 1e-9 * energies[0]);
  }
}

}  // namespace
}  // namespace ceres_ed
