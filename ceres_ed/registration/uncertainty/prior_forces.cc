#include "ceres_ed/registration/uncertainty/prior_forces.h"

#include <ceres_ed/linear_algebra/block_cholesky.h>
#include <ceres_ed/linear_algebra/block_structure.h>
#include <ceres_ed/problem/problem_config.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>

#include <cost_functions/node_parameters.h>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

// The step of the numeric derivative along a mode, in units of its field.
constexpr double kStep = 1e-4;

std::vector<double> WeightsOf(const FitProblem& problem) {
  std::vector<double> weights;
  weights.reserve(problem.builder().num_terms());
  for (int term = 0; term < problem.builder().num_terms(); ++term) {
    weights.push_back(problem.builder().weight(term));
  }
  return weights;
}

// Returns a vector in the order of all nodes, from one in that of the variable nodes.
Eigen::VectorXd Spread(const Eigen::VectorXd& values,
                       const std::vector<int>& nodes,
                       int num_nodes) {
  const Eigen::Index size = static_cast<Eigen::Index>(kNodeSize) * num_nodes;
  Eigen::VectorXd spread = Eigen::VectorXd::Zero(size);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    spread.segment<kNodeSize>(kNodeSize * nodes[i]) =
        values.segment<kNodeSize>(kNodeSize * static_cast<Eigen::Index>(i));
  }
  return spread;
}

// Returns the forces against `motions` of the terms that are switched on.
std::vector<Eigen::VectorXd> ForcesOf(const ProblemBuilder& builder,
                                      const DeformationState& state,
                                      const std::vector<Eigen::VectorXd>& motions,
                                      int num_threads) {
  NormalEquations equations(builder, FullConfig(state.num_nodes(), false));
  const BlockStructure structure(equations.BlockSizes(), equations.BlockPairs());
  CHECK(equations.SetStructure(&structure));
  const auto gradient_at = [&](const Eigen::VectorXd& motion) {
    DeformationState moved = state;
    for (int j = 0; j < moved.num_nodes(); ++j) {
      for (int i = 0; i < kNodeSize; ++i) moved.node(j)[i] += motion[kNodeSize * j + i];
    }
    double cost = 0.0;
    Eigen::VectorXd gradient;
    if (!equations.EvaluateGradient(moved, num_threads, &cost, &gradient)) {
      gradient.setZero(kNodeSize * equations.num_variable_nodes());
    }
    return gradient;
  };
  const Eigen::Index size = static_cast<Eigen::Index>(kNodeSize) * state.num_nodes();
  const Eigen::VectorXd at_rest = gradient_at(Eigen::VectorXd::Zero(size));
  std::vector<Eigen::VectorXd> forces;
  forces.reserve(motions.size());
  for (const Eigen::VectorXd& motion : motions) {
    forces.push_back(Spread((gradient_at(kStep * motion) - at_rest) / kStep,
                            equations.variable_nodes(),
                            state.num_nodes()));
  }
  return forces;
}

}  // namespace

PriorForces::PriorForces(const DeformationGraph& graph,
                         const DeformationState& state,
                         const std::vector<SmoothMode>& modes,
                         int num_threads,
                         FitProblem* problem)
    : num_modes_(modes.size()) {
  std::vector<Eigen::VectorXd> motions;
  motions.reserve(modes.size());
  for (const SmoothMode& mode : modes) motions.push_back(NodeMotion(mode, graph));
  const std::vector<double> weights = WeightsOf(*problem);
  for (std::size_t term = 0; term < weights.size(); ++term) {
    if (!problem->rule(static_cast<int>(term)).stiff || weights[term] == 0.0) continue;
    std::vector<double> alone(weights.size(), 0.0);
    alone[term] = 1.0;
    problem->SetWeights(alone);
    terms_.push_back(static_cast<int>(term));
    forces_.push_back(ForcesOf(problem->builder(), state, motions, num_threads));
  }
  problem->SetWeights(weights);
}

std::vector<Eigen::VectorXd> PriorForces::Of(const FitProblem& problem) const {
  std::vector<Eigen::VectorXd> sums;
  if (terms_.empty()) return sums;
  for (std::size_t mode = 0; mode < num_modes_; ++mode) {
    Eigen::VectorXd& sum = sums.emplace_back(Eigen::VectorXd::Zero(forces_[0][mode].size()));
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      sum += problem.builder().weight(terms_[i]) * forces_[i][mode];
    }
  }
  return sums;
}

std::vector<Eigen::VectorXd> PriorForces::HeldBack(const FitProblem& problem,
                                                   const DeformationState& state,
                                                   int num_threads) const {
  const ProblemBuilder& builder = problem.builder();
  NormalEquations equations(builder, FullConfig(state.num_nodes(), false));
  const BlockStructure structure(equations.BlockSizes(), equations.BlockPairs());
  CHECK(equations.SetStructure(&structure));
  double cost = 0.0;
  std::vector<double> values;
  Eigen::VectorXd gradient;
  if (!equations.Evaluate(state, num_threads, &cost, &values, &gradient)) return {};
  // Directions that nothing determines stay where they are.
  constexpr double kRegularization = 1e-10;
  const Eigen::VectorXd diagonal = structure.Diagonal(values);
  const double least = diagonal.size() > 0 ? diagonal.mean() : 1.0;
  BlockCholesky factor(structure);
  if (!factor.Factorize(
          values.data(), kRegularization * (diagonal.array() + least).matrix(), num_threads)) {
    return {};
  }
  const std::vector<int>& nodes = equations.variable_nodes();
  std::vector<Eigen::VectorXd> missed;
  for (const Eigen::VectorXd& force : Of(problem)) {
    Eigen::VectorXd rhs(kNodeSize * static_cast<Eigen::Index>(nodes.size()));
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      rhs.segment<kNodeSize>(kNodeSize * static_cast<Eigen::Index>(i)) =
          force.segment<kNodeSize>(kNodeSize * nodes[i]);
    }
    missed.push_back(Spread(factor.Solve(rhs), nodes, state.num_nodes()));
  }
  return missed;
}

}  // namespace ceres_ed
