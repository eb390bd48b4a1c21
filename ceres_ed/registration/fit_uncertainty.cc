#include "ceres_ed/registration/fit_uncertainty.h"

#include <ceres_ed/solver/covariance/state_covariance.h>
#include <ceres_ed/solver/covariance/variance_factor.h>
#include <ceres_ed/util/parallel.h>
#include <ceres_ed/util/timer.h>

#include <cmath>
#include <sstream>

namespace ceres_ed {
namespace {

// Returns sqrt(tr(variance_factor Cov(p))) for every point.
std::vector<double> PointDeviations(const StateCovariance& covariance,
                                    const Skinning& skinning,
                                    const std::vector<Eigen::Vector3d>& points,
                                    double variance_factor,
                                    int num_threads) {
  std::vector<double> deviations(points.size());
  ParallelFor(num_threads, static_cast<int>(points.size()), [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      const double trace = covariance.Point(points[p], skinning[p]).trace();
      // Rounding may make a variance near zero negative.
      deviations[p] = trace < 0.0 ? 0.0 : std::sqrt(variance_factor * trace);
    }
  });
  return deviations;
}

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

void DropUncertainty(const std::string& why, FitResult* result) {
  result->uncertainty = {};
  result->warnings.push_back("no standard deviations: " + why);
}

void MeasureUncertainty(const UnitFit& fit,
                        const BuiltGraph& graph,
                        const FitProblem& problem,
                        const DeformationState& state,
                        FitResult* result) {
  const Timer timer;
  const ProblemBuilder& builder = problem.builder();
  const int num_threads = fit.options->num_threads;
  const ProblemConfig config = FullConfig(graph.graph.num_nodes(), builder.has_camera());
  const StatusOr<StateCovariance> covariance =
      StateCovariance::Compute(builder, config, state, {&graph.skinning, num_threads});
  if (!covariance.ok()) return DropUncertainty(covariance.status().message(), result);
  const StatusOr<VarianceFactor> factor = EstimateVarianceFactor(
      builder, config, state, *covariance, problem.MeasuredTerms(), num_threads);
  if (!factor.ok()) return DropUncertainty(factor.status().message(), result);
  if (!(factor->redundancy() > 0.0)) {
    return DropUncertainty("the data are no more than the parameters that they determine", result);
  }
  FitUncertainty& uncertainty = result->uncertainty;
  uncertainty.variance_factor = factor->value;
  uncertainty.std_dev = PointDeviations(
      *covariance, graph.skinning, fit.source->cloud().points, factor->value, num_threads);
  uncertainty.undetermined_nodes = covariance->undetermined();
  WarnAboutNodes(uncertainty.undetermined_nodes, graph.graph.num_nodes(), result);
  uncertainty.time = timer.Seconds();
}

}  // namespace ceres_ed
