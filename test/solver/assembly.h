// Assembles the normal equations of a test problem in blocks and with Ceres.
#ifndef CERES_ED_TEST_SOLVER_ASSEMBLY_H_
#define CERES_ED_TEST_SOLVER_ASSEMBLY_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>
#include <ceres_ed/testing/residual_collection.h>
#include <ceres_ed/testing/test_problem.h>

#include <memory>
#include <vector>

#include <Eigen/Core>
#include <ceres/crs_matrix.h>
#include <gtest/gtest.h>
#include <test/linear_algebra/dense_matrix.h>

namespace ceres_ed {

// Returns a builder with all energies of a test problem, each with its weight and loss.
inline std::unique_ptr<ProblemBuilder> MakeBuilder(const TestProblem& problem,
                                                   const LossSpec& loss) {
  const EnergyRegistry registry = BuiltinEnergies();
  auto builder = std::make_unique<ProblemBuilder>(problem.graph, problem.has_camera);
  const EnergyContext context = problem.Context();
  const auto add = [&](const char* name, double weight, const LossSpec& term_loss) {
    const StatusOr<std::unique_ptr<EnergyTerm>> energy = registry.Create(name, {});
    ASSERT_TRUE(energy.ok()) << energy.status().message();
    const int term = builder->AddTerm(name, (*energy)->kind(), weight, term_loss);
    builder->CollectResiduals(term, **energy, context);
  };
  add("rotation", 1.0, {});
  add("regularization", 10.0, {});
  add("point_to_plane", 50.0, loss);
  add("point_to_point", 5.0, loss);
  add("landmark", 2.0, {});
  if (problem.has_camera) add("pose_prior", 0.1, {});
  return builder;
}

inline TestProblem MakeProblem(bool has_camera) {
  TestProblemOptions options;
  options.columns = 7;
  options.rows = 4;
  options.points_per_cell = 3;
  options.observed_columns = 3;
  options.has_camera = has_camera;
  options.target_deviation = 0.1;
  return MakeTestProblem(options);
}

struct Assembled {
  double cost = 0.0;
  Eigen::MatrixXd H;
  Eigen::VectorXd gradient;
};

inline Assembled AssembleInBlocks(const ProblemBuilder& builder,
                                  const ProblemConfig& config,
                                  const DeformationState& state,
                                  int num_threads) {
  NormalEquations equations(builder, config);
  const BlockStructure structure(equations.BlockSizes(), equations.BlockPairs());
  EXPECT_TRUE(equations.SetStructure(&structure));
  Assembled assembled;
  std::vector<double> values;
  EXPECT_TRUE(
      equations.Evaluate(state, num_threads, &assembled.cost, &values, &assembled.gradient));
  assembled.H = DenseOf(structure, values);
  return assembled;
}

// Returns the same from ceres::Problem::Evaluate(): variable nodes in order, then rotation and
// translation.
inline Assembled AssembleWithCeres(const ProblemBuilder& builder,
                                   const ProblemConfig& config,
                                   DeformationState* state) {
  const BuiltProblem built = builder.Build(config, state);
  ceres::Problem::EvaluateOptions options;
  for (int j = 0; j < state->num_nodes(); ++j) {
    if (config.variable_nodes[j] != 0) options.parameter_blocks.push_back(state->node(j));
  }
  if (config.camera_variable) {
    options.parameter_blocks.push_back(state->camera_from_map.rotation.coeffs().data());
    options.parameter_blocks.push_back(state->camera_from_map.translation.data());
  }
  Assembled assembled;
  ceres::CRSMatrix crs;
  std::vector<double> gradient;
  EXPECT_TRUE(built.problem->Evaluate(options, &assembled.cost, nullptr, &gradient, &crs));
  const Eigen::MatrixXd J = DenseOf(crs);
  assembled.H = J.transpose() * J;
  assembled.gradient = Eigen::Map<Eigen::VectorXd>(gradient.data(), gradient.size());
  return assembled;
}

inline void ExpectClose(const Assembled& blocks, const Assembled& ceres) {
  constexpr double kRounding = 1e-12;
  EXPECT_NEAR(blocks.cost, ceres.cost, kRounding * ceres.cost);
  ASSERT_EQ(blocks.H.rows(), ceres.H.rows());
  EXPECT_LT((blocks.H - ceres.H).norm(), kRounding * ceres.H.norm());
  EXPECT_LT((blocks.gradient - ceres.gradient).norm(), kRounding * ceres.gradient.norm());
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_SOLVER_ASSEMBLY_H_
