// Covariances against what they are about: how far the minimum goes when every residual is given
// an error of its own.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/solver/covariance/state_covariance.h>
#include <ceres_ed/testing/residual_collection.h>
#include <ceres_ed/testing/test_problem.h>

#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// Standard deviation of a residual: small, so that the problem is linear over it.
constexpr double kSigma = 1e-3;
constexpr int kSamples = 500;

// A residual with an error that can be drawn anew.
class NoisyCost final : public ceres::CostFunction {
 public:
  explicit NoisyCost(std::shared_ptr<const ceres::CostFunction> cost) : cost_(std::move(cost)) {
    set_num_residuals(cost_->num_residuals());
    *mutable_parameter_block_sizes() = cost_->parameter_block_sizes();
    error_.setZero(cost_->num_residuals());
  }

  void Draw(std::mt19937_64* random) {
    std::normal_distribution<double> normal(0.0, kSigma);
    for (double& e : error_) e = normal(*random);
  }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    if (!cost_->Evaluate(parameters, residuals, jacobians)) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, error_.size()) += error_;
    return true;
  }

 private:
  std::shared_ptr<const ceres::CostFunction> cost_;
  Eigen::VectorXd error_;
};

class Sampler {
 public:
  Sampler() : problem_(MakeTestProblem(Options())), builder_(problem_.graph, true) {
    const EnergyRegistry registry = BuiltinEnergies();
    for (const char* name :
         {"rotation", "regularization", "node_prior", "pose_prior", "point_to_point"}) {
      const auto energy = registry.Create(name, {});
      // Whitened, as StateCovariance takes residuals.
      const int term = builder_.AddTerm(name, (*energy)->kind(), 1.0 / (kSigma * kSigma));
      builder_.CollectResiduals(term, **energy, problem_.Context());
    }
    config_ = FullConfig(problem_.graph.num_nodes(), true);
    state_ = DeformationState(problem_.graph.num_nodes());
    for (const SelectedResidual& residual : builder_.Select(config_)) {
      costs_.push_back(std::make_unique<NoisyCost>(residual.CostFunction(problem_.graph)));
      blocks_.emplace_back(residual.blocks, residual.blocks + residual.num_blocks);
    }
    Minimize(&state_);
  }

  // What is measured: nodes, a point in the map and in the camera, the camera's tangent.
  Eigen::VectorXd Measure(const DeformationState& state) const {
    Eigen::VectorXd values(2 * kNodeSize + 3 + 3 + 6);
    values.segment<kNodeSize>(0) = Eigen::Map<const Eigen::VectorXd>(state.node(0), kNodeSize);
    values.segment<kNodeSize>(kNodeSize) =
        Eigen::Map<const Eigen::VectorXd>(state.node(Hidden()), kNodeSize);
    const Eigen::Vector3d point =
        WarpPoint(problem_.graph, state, problem_.skinning[0], problem_.points[0]);
    values.segment<3>(2 * kNodeSize) = point;
    values.segment<3>(2 * kNodeSize + 3) = state.camera_from_map * point;
    Eigen::Vector3d turn;
    ceres::EigenQuaternionManifold().Minus(state.camera_from_map.rotation.coeffs().data(),
                                           state_.camera_from_map.rotation.coeffs().data(),
                                           turn.data());
    values.segment<3>(2 * kNodeSize + 6) = turn;
    values.tail<3>() = state.camera_from_map.translation;
    return values;
  }

  // The variances that StateCovariance predicts of Measure().
  Eigen::VectorXd Predict() const {
    const StatusOr<StateCovariance> covariance =
        StateCovariance::Compute(builder_, config_, state_, {});
    CHECK(covariance.ok()) << covariance.status().message();
    Eigen::VectorXd variances(2 * kNodeSize + 3 + 3 + 6);
    variances << covariance->Node(0).diagonal(), covariance->Node(Hidden()).diagonal(),
        covariance->Point(problem_.points[0], problem_.skinning[0]).diagonal(),
        covariance->PointInCamera(problem_.points[0], problem_.skinning[0]).diagonal(),
        covariance->Camera().diagonal();
    return variances;
  }

  // Mean squared deviation of Measure() from the minimum without errors.
  Eigen::VectorXd Sample() {
    std::mt19937_64 random(7);
    const Eigen::VectorXd mean = Measure(state_);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(mean.size());
    for (int k = 0; k < kSamples; ++k) {
      for (const auto& cost : costs_) cost->Draw(&random);
      DeformationState sample = state_;
      Minimize(&sample);
      sum += (Measure(sample) - mean).cwiseAbs2();
    }
    return sum / kSamples;
  }

 private:
  static TestProblemOptions Options() {
    TestProblemOptions options;
    options.columns = 4;
    options.rows = 2;
    options.points_per_cell = 3;
    options.observed_columns = 2;
    options.has_camera = true;
    return options;
  }

  // Returns a node of the last column, which nothing observes.
  int Hidden() const { return problem_.graph.num_nodes() - 1; }

  void Minimize(DeformationState* state) {
    ceres::Problem::Options problem_options;
    problem_options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem problem(problem_options);
    for (std::size_t i = 0; i < costs_.size(); ++i) {
      std::vector<double*> pointers;
      for (const BlockRef& block : blocks_[i]) {
        pointers.push_back(const_cast<double*>(BlockPointer(*state, block)));
      }
      problem.AddResidualBlock(costs_[i].get(), nullptr, pointers);
    }
    problem.SetManifold(state->camera_from_map.rotation.coeffs().data(),
                        new ceres::EigenQuaternionManifold());
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.initial_trust_region_radius = 1e12;
    options.function_tolerance = 1e-14;
    options.parameter_tolerance = 1e-14;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    CHECK(summary.IsSolutionUsable()) << summary.message;
  }

  TestProblem problem_;
  ProblemBuilder builder_;
  ProblemConfig config_;
  DeformationState state_;
  std::vector<std::unique_ptr<NoisyCost>> costs_;
  std::vector<std::vector<BlockRef>> blocks_;
};

TEST(StateCovariance, IsTheSpreadOfTheMinimumOverErrorsOfTheResiduals) {
  Sampler sampler;
  const Eigen::VectorXd predicted = sampler.Predict();
  const Eigen::VectorXd sampled = sampler.Sample();
  // A variance from n normal samples has the relative deviation sqrt(2 / n); of 36 none is beyond
  // four of these but once in 400 draws.
  const double bound = 4.0 * std::sqrt(2.0 / kSamples);
  for (int i = 0; i < predicted.size(); ++i) {
    EXPECT_GT(predicted[i], 0.0) << i;
    EXPECT_NEAR(sampled[i] / predicted[i], 1.0, bound) << i;
  }
}

}  // namespace
}  // namespace ceres_ed
