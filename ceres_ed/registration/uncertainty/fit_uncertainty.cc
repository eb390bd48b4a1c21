#include "ceres_ed/registration/uncertainty/fit_uncertainty.h"

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/linear_algebra/block_structure.h>
#include <ceres_ed/registration/uncertainty/smooth_modes.h>
#include <ceres_ed/registration/uncertainty/statistical_weights.h>
#include <ceres_ed/solver/covariance/state_covariance.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>
#include <ceres_ed/util/parallel.h>
#include <ceres_ed/util/timer.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <sstream>
#include <utility>

#include <cost_functions/node_parameters.h>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

// The part of the deformation's own amplitude that counts as unknown in each smooth mode: the
// modes share it.
constexpr double kModeShare = 0.7;
// The step of the numeric derivative along a mode, in units of its field.
constexpr double kStep = 1e-4;

// Computes H_prior v, the force with which the priors resist a change of the nodes.
class PriorForce {
 public:
  // Switches off all terms but the priors of `problem` while it is set up.
  PriorForce(const BuiltGraph& graph,
             const DeformationState& state,
             int num_threads,
             FitProblem* problem)
      : state_(state), num_threads_(num_threads) {
    const ProblemBuilder& builder = problem->builder();
    std::vector<double> weights;
    std::vector<double> of_priors;
    for (int term = 0; term < builder.num_terms(); ++term) {
      weights.push_back(builder.weight(term));
      of_priors.push_back(problem->rule(term).stiff ? weights.back() : 0.0);
    }
    problem->SetWeights(of_priors);
    equations_ = NormalEquations(builder, FullConfig(graph.graph.num_nodes(), false));
    structure_.emplace(equations_.BlockSizes(), equations_.BlockPairs());
    CHECK(equations_.SetStructure(&*structure_));
    problem->SetWeights(weights);
  }

  // Returns the force for each node, in the order of the nodes. Nodes without a prior have none.
  Eigen::VectorXd Of(const Eigen::VectorXd& motion) const {
    const Eigen::VectorXd difference = GradientAt(kStep * motion) - GradientAt(-kStep * motion);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(motion.size());
    const std::vector<int>& nodes = equations_.variable_nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      force.segment<kNodeSize>(kNodeSize * nodes[i]) =
          difference.segment<kNodeSize>(kNodeSize * static_cast<Eigen::Index>(i)) / (2.0 * kStep);
    }
    return force;
  }

 private:
  Eigen::VectorXd GradientAt(const Eigen::VectorXd& motion) const {
    DeformationState moved = state_;
    for (int j = 0; j < moved.num_nodes(); ++j) {
      for (int i = 0; i < kNodeSize; ++i) moved.node(j)[i] += motion[kNodeSize * j + i];
    }
    double cost = 0.0;
    Eigen::VectorXd gradient;
    if (!equations_.EvaluateGradient(moved, num_threads_, &cost, &gradient)) {
      gradient.setZero(kNodeSize * equations_.num_variable_nodes());
    }
    return gradient;
  }

  const DeformationState& state_;
  const int num_threads_;
  NormalEquations equations_;
  std::optional<BlockStructure> structure_;
};

// Returns what the estimate gets wrong if the deformation has one standard deviation of each mode:
// H^-1 H_prior v, since the priors pull against it where no data do. One column of node changes for
// each mode.
std::vector<Eigen::VectorXd> ModeErrors(const UnitFit& fit,
                                        const BuiltGraph& graph,
                                        const DeformationState& state,
                                        const StateCovariance& covariance,
                                        FitProblem* problem) {
  const PriorForce prior(graph, state, fit.options->num_threads, problem);
  std::vector<Eigen::VectorXd> errors;
  for (const SmoothMode& mode :
       FindSmoothModes(graph.graph, state, problem->builder().PointRelevantNodes())) {
    if (mode.amplitude == 0.0) continue;
    errors.push_back(kModeShare * mode.amplitude *
                     covariance.SolveNodes(prior.Of(NodeMotion(mode, graph.graph))));
  }
  return errors;
}

// Returns the change of a warped point (Eq. 1) for a change of all nodes.
Eigen::Vector3d PointChange(const Eigen::VectorXd& change,
                            const DeformationGraph& graph,
                            const Binding& binding,
                            const Eigen::Vector3d& point) {
  Eigen::Vector3d moved = Eigen::Vector3d::Zero();
  for (int i = 0; i < binding.size; ++i) {
    const int node = binding.nodes[i];
    const double* of_node = change.data() + static_cast<std::ptrdiff_t>(kNodeSize) * node;
    moved += binding.weights[i] *
             (NodeAffine(of_node) * (point - graph.position(node)) + NodeTranslation(of_node));
  }
  return moved;
}

// How much more is unknown where no node has data, because of what smooth modes leave out.
class Extrapolation {
 public:
  Extrapolation(const BuiltGraph& graph, std::vector<char> is_observed)
      : graph_(graph), is_observed_(std::move(is_observed)) {
    constexpr double kHalf = 0.5;
    std::size_t hidden = 0;
    const std::size_t size = graph_.skinning.size();
    for (std::size_t p = 0; p < size; ++p) {
      if (SeenShare(graph_.skinning[static_cast<int>(p)]) < kHalf) ++hidden;
    }
    const double ratio =
        static_cast<double>(hidden) / static_cast<double>(std::max<std::size_t>(size - hidden, 1));
    excess_ = ratio * ratio;
  }

  // Returns the factor of the variance of a point.
  double Factor(const Binding& binding) const { return 1.0 + (1.0 - SeenShare(binding)) * excess_; }

 private:
  // Returns the weight of the nodes with data.
  double SeenShare(const Binding& binding) const {
    double share = 0.0;
    for (int i = 0; i < binding.size; ++i) {
      if (is_observed_[binding.nodes[i]] != 0) share += binding.weights[i];
    }
    return std::min(share, 1.0);
  }

  const BuiltGraph& graph_;
  const std::vector<char> is_observed_;
  // Modes of the next degree have coefficients that are smaller by the extent of the seen part, on
  // which the deformation was found, and values that are larger by the extent of the hidden part:
  // the ratio of the areas, as a variance. The modes at hand have degrees up to two, so that those
  // that are left out begin two degrees above the linear ones.
  double excess_ = 0.0;
};

void WarnAboutNodes(const std::vector<int>& undetermined, int num_nodes, FitResult* result) {
  if (undetermined.empty()) return;
  std::ostringstream message;
  message << undetermined.size() << " of " << num_nodes << " nodes (the first is node "
          << undetermined.front()
          << ") are undetermined: no data and no prior says where they are; the points that they "
             "carry have no standard deviation";
  result->warnings.push_back(message.str());
}

}  // namespace

std::vector<double> FitUncertainty::StandardDeviations() const {
  std::vector<double> deviations;
  deviations.reserve(covariances.size());
  for (const Eigen::Matrix3d& covariance : covariances) {
    // Rounding may make a variance near zero negative.
    const double trace = covariance.trace();
    deviations.push_back(trace < 0.0 ? 0.0 : std::sqrt(trace));
  }
  return deviations;
}

void DropUncertainty(const std::string& why, FitResult* result) {
  result->uncertainty = {};
  result->warnings.push_back("no standard deviations: " + why);
}

void MeasureUncertainty(const UnitFit& fit,
                        const BuiltGraph& graph,
                        const DeformationState& state,
                        const WaySpread& ways,
                        FitProblem* problem,
                        FitResult* result) {
  const Timer timer;
  const int num_threads = fit.options->num_threads;
  problem->SetWeights(StatisticalWeights(*problem, graph, state));
  const StatusOr<StateCovariance> covariance =
      StateCovariance::Compute(problem->builder(),
                               FullConfig(graph.graph.num_nodes(), problem->builder().has_camera()),
                               state,
                               {&graph.skinning, num_threads});
  if (!covariance.ok()) return DropUncertainty(covariance.status().message(), result);
  const std::vector<Eigen::VectorXd> errors = ModeErrors(fit, graph, state, *covariance, problem);
  const Extrapolation extrapolation(graph, problem->builder().PointRelevantNodes());
  FitUncertainty& uncertainty = result->uncertainty;
  const std::vector<Eigen::Vector3d>& points = fit.source->cloud().points;
  uncertainty.covariances.resize(points.size());
  ParallelFor(num_threads, static_cast<int>(points.size()), [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      const Binding binding = graph.skinning[p];
      Eigen::Matrix3d sum = covariance->Point(points[p], binding);
      for (const Eigen::VectorXd& error : errors) {
        const Eigen::Vector3d change = PointChange(error, graph.graph, binding, points[p]);
        sum += change * change.transpose();
      }
      const Eigen::Vector3d place = WarpPoint(graph.graph, state, binding, points[p]);
      uncertainty.covariances[p] =
          FitUncertainty::kScale *
          (extrapolation.Factor(binding) * sum + ways.About(place, static_cast<std::size_t>(p)));
    }
  });
  uncertainty.undetermined_nodes = covariance->undetermined();
  WarnAboutNodes(uncertainty.undetermined_nodes, graph.graph.num_nodes(), result);
  uncertainty.time = timer.Seconds();
}

}  // namespace ceres_ed
