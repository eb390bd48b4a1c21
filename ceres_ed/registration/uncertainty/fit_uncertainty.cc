#include "ceres_ed/registration/uncertainty/fit_uncertainty.h"

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/registration/uncertainty/missed_motion.h>
#include <ceres_ed/registration/uncertainty/prior_forces.h>
#include <ceres_ed/registration/uncertainty/smooth_modes.h>
#include <ceres_ed/registration/uncertainty/statistical_weights.h>
#include <ceres_ed/solver/covariance/state_covariance.h>
#include <ceres_ed/util/parallel.h>
#include <ceres_ed/util/timer.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <utility>

#include <cost_functions/node_parameters.h>

namespace ceres_ed {
namespace {

// The part of the deformation's own amplitude that counts as unknown in each smooth mode: the
// modes share it.
constexpr double kModeShare = 0.7;

// Returns what the estimate gets wrong if the deformation has one standard deviation of each mode:
// H^-1 H_prior v, since the priors pull against it where no data do. One column of node changes for
// each mode.
std::vector<Eigen::VectorXd> ModeErrors(const StateCovariance& covariance,
                                        const std::vector<SmoothMode>& modes,
                                        const std::vector<Eigen::VectorXd>& forces) {
  std::vector<Eigen::VectorXd> errors;
  for (std::size_t m = 0; m < forces.size(); ++m) {
    if (modes[m].amplitude == 0.0) continue;
    errors.push_back(kModeShare * modes[m].amplitude * covariance.SolveNodes(forces[m]));
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

  // Returns the factor of the variance of a point, where its nodes with data have the weight
  // `seen`.
  double Factor(double seen) const { return 1.0 + (1.0 - seen) * excess_; }

  // Returns the weight of the nodes with data.
  double SeenShare(const Binding& binding) const {
    double share = 0.0;
    for (int i = 0; i < binding.size; ++i) {
      if (is_observed_[binding.nodes[i]] != 0) share += binding.weights[i];
    }
    return std::min(share, 1.0);
  }

 private:
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
  const std::vector<char> is_observed = problem->builder().PointRelevantNodes();
  const std::vector<SmoothMode> modes = FindSmoothModes(graph.graph, state, is_observed);
  const PriorForces prior(graph.graph, state, modes, num_threads, problem);
  const MissedMotion missed(
      graph.graph, state, is_observed, modes, prior.HeldBack(*problem, state, num_threads));
  problem->SetWeights(StatisticalWeights(*problem, graph, state));
  const StatusOr<StateCovariance> covariance =
      StateCovariance::Compute(problem->builder(),
                               FullConfig(graph.graph.num_nodes(), problem->builder().has_camera()),
                               state,
                               {&graph.skinning, num_threads});
  if (!covariance.ok()) return DropUncertainty(covariance.status().message(), result);
  const std::vector<Eigen::VectorXd> errors = ModeErrors(*covariance, modes, prior.Of(*problem));
  const Extrapolation extrapolation(graph, is_observed);
  FitUncertainty& uncertainty = result->uncertainty;
  const PointCloud& cloud = fit.source->cloud();
  uncertainty.covariances.resize(cloud.size());
  ParallelFor(num_threads, static_cast<int>(cloud.size()), [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      const Eigen::Vector3d& point = cloud.points[p];
      const Binding binding = graph.skinning[p];
      Eigen::Matrix3d sum = covariance->Point(point, binding);
      for (const Eigen::VectorXd& error : errors) {
        const Eigen::Vector3d change = PointChange(error, graph.graph, binding, point);
        sum += change * change.transpose();
      }
      const double seen = extrapolation.SeenShare(binding);
      const Eigen::Vector3d normal = cloud.HasNormals()
                                         ? WarpNormal(state, binding, cloud.normals[p])
                                         : Eigen::Vector3d(Eigen::Vector3d::Zero());
      const Eigen::Vector3d place = WarpPoint(graph.graph, state, binding, point);
      uncertainty.covariances[p] =
          FitUncertainty::kScale *
          (extrapolation.Factor(seen) * sum + missed.Covariance(seen, normal) +
           ways.About(place, static_cast<std::size_t>(p)));
    }
  });
  uncertainty.undetermined_nodes = covariance->undetermined();
  WarnAboutNodes(uncertainty.undetermined_nodes, graph.graph.num_nodes(), result);
  uncertainty.time = timer.Seconds();
}

}  // namespace ceres_ed
