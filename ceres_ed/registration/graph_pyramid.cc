#include "ceres_ed/registration/graph_pyramid.h"

#include <ceres_ed/graph/binding.h>
#include <ceres_ed/graph/edges.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/registration/nonrigid_loop.h>

#include <cmath>
#include <utility>

namespace ceres_ed {
namespace {

// A node of a piece without landmarks follows this many nodes of other pieces within this many node
// spacings.
constexpr int kCarryingEdges = 12;
constexpr double kCarryingReach = 1.5;

// Returns whether the fit was stopped, as opposed to failed.
bool EndedEarlyBy(const FitResult& result) {
  return result.status == SolveStatus::kInterrupted || result.status == SolveStatus::kTimeLimit;
}

// Returns a graph of a few nodes that takes no time to build: the warp of a fit that was stopped
// before its graph was there. Its points do not move.
StatusOr<BuiltGraph> GraphForNoTime(const Surface& source) {
  GraphOptions options;
  options.distance = DistanceRule::kEuclidean;
  options.auto_spacing = 0.3;
  // How the points are connected does not matter to so few nodes, and takes longest to find.
  PointCloud points;
  points.points = source.cloud().points;
  return BuildGraph(points, options);
}

// Links the pieces of the source that have no landmark to the pieces near them: landmarks on some
// pieces carry the pieces between them.
void CarryPiecesWithoutLandmarks(const UnitFit& fit, BuiltGraph* built) {
  const SurfaceTopology& topology = fit.source->topology();
  if (fit.landmarks.empty() || built->binding.distance != DistanceRule::kSurface) return;
  std::vector<char> is_carried(topology.num_components(), 1);
  for (const auto* held : {&fit.landmarks, &fit.fixed}) {
    for (const Correspondence& point : *held) is_carried[topology.component[point.point]] = 0;
  }
  std::vector<int> piece;
  for (const int point : built->node_points) piece.push_back(topology.component[point]);
  // Nodes inside belong to no piece.
  piece.resize(built->graph.num_nodes(), static_cast<int>(is_carried.size()));
  is_carried.push_back(0);
  CarryPieces(
      piece, is_carried, kCarryingEdges, kCarryingReach * built->node_spacing, &built->graph);
}

}  // namespace

StatusOr<GraphPyramid> GraphPyramid::Build(const UnitFit& fit, int resolutions, FitResult* result) {
  const Timer timer;
  GraphPyramid pyramid(fit);
  const Surface& source = *fit.source;
  GraphOptions fine = fit.options->graph;
  fine.should_stop = [&fit, result] { return MustEnd(fit, result); };
  StatusOr<BuiltGraph> finest = MustEnd(fit, result)
                                    ? GraphForNoTime(source)
                                    : BuildGraph(source.cloud(), source.topology(), fine);
  if (!finest.ok() && EndedEarlyBy(*result)) finest = GraphForNoTime(source);
  if (!finest.ok()) return finest.status();
  result->warnings.insert(result->warnings.end(), finest->warnings.begin(), finest->warnings.end());
  for (int resolution = resolutions - 1; resolution > 0; --resolution) {
    if (MustEnd(fit, result)) break;
    GraphOptions options = fine;
    options.node_spacing = finest->node_spacing * std::pow(2.0, resolution);
    options.target_nodes = 0;
    StatusOr<BuiltGraph> coarse = BuildGraph(source.cloud(), source.topology(), options);
    // A body with few nodes has no coarser graph; the finer resolutions then do all the work.
    if (coarse.ok()) pyramid.graphs_.push_back(*std::move(coarse));
  }
  pyramid.graphs_.push_back(*std::move(finest));
  for (BuiltGraph& graph : pyramid.graphs_) CarryPiecesWithoutLandmarks(fit, &graph);
  result->times.graph = timer.Seconds();
  return pyramid;
}

DeformationState GraphPyramid::CarryOver(const DeformationState& state, int from, int to) const {
  const BuiltGraph& graph = graphs_[from];
  const BuiltGraph& next = graphs_[to];
  const std::vector<Eigen::Vector3d>& points = fit_->source->cloud().points;
  DeformationState carried(next.graph.num_nodes());
  const auto carry = [&](int node, const Binding& binding, const Eigen::Vector3d& point) {
    MutableNodeAffine(carried.node(node)) = WarpGradient(state, binding);
    MutableNodeTranslation(carried.node(node)) =
        WarpPoint(graph.graph, state, binding, point) - point;
  };
  const int num_surface_nodes = next.graph.num_surface_nodes();
  for (int j = 0; j < num_surface_nodes; ++j) {
    carry(j, graph.skinning[next.node_points[j]], points[next.node_points[j]]);
  }
  std::vector<Eigen::Vector3d> inner;
  for (int j = num_surface_nodes; j < carried.num_nodes(); ++j) {
    inner.push_back(next.graph.position(j));
  }
  const Skinning skinning = BindInBody(inner, graph.graph, graph.binding.num_threads);
  for (std::size_t i = 0; i < inner.size(); ++i) {
    carry(num_surface_nodes + static_cast<int>(i), skinning[i], inner[i]);
  }
  return carried;
}

}  // namespace ceres_ed
