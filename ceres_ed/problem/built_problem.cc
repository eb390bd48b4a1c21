// The part of ProblemBuilder that builds a ceres::Problem.
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/util/describe_throw.h>

#include <map>
#include <memory>
#include <string>
#include <utility>

#include <ceres/manifold.h>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

void AddCamera(const ProblemConfig& config, DeformationState* state, BuiltProblem* built) {
  double* rotation = state->camera_from_map.rotation.coeffs().data();
  double* translation = state->camera_from_map.translation.data();
  if (built->problem->HasParameterBlock(rotation)) {
    built->rotation_manifold = std::make_unique<ceres::EigenQuaternionManifold>();
    built->problem->SetManifold(rotation, built->rotation_manifold.get());
    if (!config.camera_variable) built->problem->SetParameterBlockConstant(rotation);
  }
  if (built->problem->HasParameterBlock(translation) && !config.camera_variable) {
    built->problem->SetParameterBlockConstant(translation);
  }
}

double* MutableBlockPointer(DeformationState* state, const BlockRef& block) {
  return const_cast<double*>(BlockPointer(*state, block));
}

// A wrapper of a cost function that turns exceptions into a failed evaluation, since no exception
// may leave the threads of the solver.
class GuardedCost final : public ceres::CostFunction {
 public:
  explicit GuardedCost(std::shared_ptr<const ceres::CostFunction> cost) : cost_(std::move(cost)) {
    set_num_residuals(cost_->num_residuals());
    *mutable_parameter_block_sizes() = cost_->parameter_block_sizes();
  }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    bool valid = false;
    const std::string thrown =
        DescribeThrow([&] { valid = cost_->Evaluate(parameters, residuals, jacobians); });
    return valid && thrown.empty();
  }

 private:
  std::shared_ptr<const ceres::CostFunction> cost_;
};

ceres::Problem::Options ProblemOptions() {
  ceres::Problem::Options options;
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  // The sink has already checked sizes and aliasing.
  options.disable_all_safety_checks = true;
  return options;
}

}  // namespace

BuiltProblem ProblemBuilder::Build(const ProblemConfig& config, DeformationState* state) const {
  CHECK_EQ(state->num_nodes(), graph_.num_nodes());
  BuiltProblem built;
  built.problem = std::make_unique<ceres::Problem>(ProblemOptions());
  built.camera_variable = config.camera_variable;
  // Residuals of one term that have equal weights share a loss.
  std::map<std::pair<int, double>, ceres::LossFunction*> losses;
  const auto loss_for = [&](int term, double weight) -> ceres::LossFunction* {
    if (term < 0) return nullptr;
    ceres::LossFunction*& loss = losses[{term, weight}];
    if (loss == nullptr) {
      built.losses.push_back(std::make_unique<ceres::ScaledLoss>(
          MakeLoss(terms_[term].loss).release(), weight, ceres::TAKE_OWNERSHIP));
      loss = built.losses.back().get();
    }
    return loss;
  };
  std::vector<char> touched_nodes(graph_.num_nodes(), 0);
  std::vector<double*> blocks;
  for (const SelectedResidual& residual : Select(config)) {
    blocks.clear();
    for (int i = 0; i < residual.num_blocks; ++i) {
      const BlockRef& block = residual.blocks[i];
      blocks.push_back(MutableBlockPointer(state, block));
      if (block.kind == BlockRef::Kind::kNode) touched_nodes[block.node] = 1;
    }
    built.costs.push_back(std::make_shared<GuardedCost>(residual.CostFunction(graph_)));
    // Ceres calls only const methods of a cost function that it does not own.
    built.problem->AddResidualBlock(const_cast<ceres::CostFunction*>(built.costs.back().get()),
                                    loss_for(residual.term, residual.weight),
                                    blocks.data(),
                                    residual.num_blocks);
  }
  // Hold the blocks that residuals touch and that are not variable.
  for (int j = 0; j < graph_.num_nodes(); ++j) {
    if (touched_nodes[j] == 0) continue;
    if (config.variable_nodes[j] != 0) {
      ++built.num_variable_nodes;
    } else {
      built.problem->SetParameterBlockConstant(state->node(j));
    }
  }
  AddCamera(config, state, &built);
  return built;
}

}  // namespace ceres_ed
