#include "ceres_ed/graph/graph_builder.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/geometry/sampling.h>
#include <ceres_ed/graph/edges.h>
#include <ceres_ed/graph/volume.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// The smallest automatic spacing in mean edge lengths. A smaller one would put a node on every
// other point.
constexpr double kMinEdgesPerSpacing = 2.0;
// The search for target_nodes ends when the relative error is below this tolerance, or after this
// number of samplings.
constexpr double kTargetTolerance = 0.05;
constexpr int kMaxSamplings = 8;

template <typename... Parts>
std::string Sentence(const Parts&... parts) {
  std::ostringstream stream;
  (stream << ... << parts);
  return stream.str();
}

// The input of the sampling.
struct SamplingPlan {
  const PointCloud& cloud;
  const SurfaceTopology& topology;
  const GraphOptions& options;
  // The rule that is really used. It is kSurface only if the surface is suitable.
  DistanceRule distance;
};

std::vector<int> SampleWithSpacing(const SamplingPlan& plan, double spacing) {
  FarthestPointOptions farthest;
  farthest.min_spacing = spacing;
  const bool uniform = plan.options.sampling == SamplingRule::kUniform;
  const int min_points = plan.options.min_component_points;
  if (plan.distance == DistanceRule::kSurface) {
    return uniform ? UniformDownsampleAlongSurface(plan.topology, spacing, min_points)
                   : FarthestPointSampleAlongSurface(plan.topology, farthest, min_points);
  }
  return uniform ? UniformDownsample(plan.cloud.points, spacing)
                 : FarthestPointSample(plan.cloud.points, farthest);
}

// Chooses plan.options.target_nodes nodes, and returns the spacing that this takes in `spacing`.
std::vector<int> SampleWithCount(const SamplingPlan& plan, double* spacing) {
  const int target = plan.options.target_nodes;
  if (plan.options.sampling == SamplingRule::kFarthest) {
    *spacing = 0.0;
    FarthestPointOptions farthest;
    farthest.max_count = target;
    return plan.distance == DistanceRule::kSurface
               ? FarthestPointSampleAlongSurface(
                     plan.topology, farthest, plan.options.min_component_points)
               : FarthestPointSample(plan.cloud.points, farthest);
  }
  // On a surface, the number of nodes is proportional to 1 / spacing^2. This gives the step of the
  // search. The bounds `low` and `high` keep it from repeating itself.
  double low = 0.0;
  double high = 2.0 * Diagonal(plan.cloud.points);
  double trial = 0.5 * high / std::sqrt(static_cast<double>(target) + 1.0);
  std::vector<int> best;
  const auto error = [target](const std::vector<int>& samples) {
    return std::abs(std::log(static_cast<double>(samples.size()) / target));
  };
  for (int i = 0; i < kMaxSamplings; ++i) {
    std::vector<int> samples = SampleWithSpacing(plan, trial);
    const double ratio = static_cast<double>(samples.size()) / target;
    (ratio > 1.0 ? low : high) = trial;
    if (best.empty() || error(samples) < error(best)) {
      best = std::move(samples);
      *spacing = trial;
    }
    if (error(best) <= kTargetTolerance) break;
    const double step = trial * std::sqrt(ratio);
    trial = step > low && step < high ? step : 0.5 * (low + high);
  }
  return best;
}

double AutomaticSpacing(const SamplingPlan& plan) {
  return std::max(plan.options.auto_spacing * Diagonal(plan.cloud.points),
                  kMinEdgesPerSpacing * MeanEdgeLength(plan.topology));
}

// Returns the distance to use. If most of a mesh consists of tiny parts (for example since corners
// nearly coincide but are not equal), distances along its surface are of no use.
DistanceRule ChooseDistance(const PointCloud& cloud,
                            const SurfaceTopology& topology,
                            const GraphOptions& options,
                            std::vector<std::string>* warnings) {
  if (options.distance == DistanceRule::kEuclidean || !topology.HasSurface()) {
    return DistanceRule::kEuclidean;
  }
  std::size_t covered = 0;
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    covered += topology.component_sizes[topology.component[p]] >= options.min_component_points;
  }
  if (2 * covered >= cloud.size()) return DistanceRule::kSurface;
  warnings->push_back(Sentence("only ",
                               covered,
                               " of ",
                               cloud.size(),
                               " points are in connected parts of ",
                               options.min_component_points,
                               " or more, so distances are straight lines, not along the surface"));
  return DistanceRule::kEuclidean;
}

Status CheckFinite(const PointCloud& cloud) {
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    if (!cloud.points[p].allFinite()) return Status::Error(Sentence("point ", p, " is not finite"));
  }
  return Status::Ok();
}

Status CheckInput(const PointCloud& cloud,
                  const SurfaceTopology& topology,
                  const GraphOptions& options) {
  std::string error;
  if (!options.IsValid(&error)) return Status::Error("bad graph options: " + error);
  if (cloud.empty()) return Status::Error("cannot build a graph on a cloud without points");
  CHECK_EQ(cloud.size(), topology.representative.size()) << "the topology is of another cloud";
  if (Status finite = CheckFinite(cloud); !finite.ok()) return finite;
  const int num_positions = static_cast<int>(topology.walk_order.size());
  if (num_positions < 2) {
    return Status::Error(Sentence(
        "cannot build a graph on a cloud whose ", cloud.size(), " points are all at one place"));
  }
  if (options.node_spacing == 0.0 && options.target_nodes > num_positions) {
    return Status::Error(Sentence("target_nodes is ",
                                  options.target_nodes,
                                  ", but the cloud has only ",
                                  num_positions,
                                  " different points"));
  }
  return Status::Ok();
}

void WarnAboutNodes(const SamplingPlan& plan, BuiltGraph* built) {
  const int num_nodes = static_cast<int>(built->node_points.size());
  if (num_nodes <= plan.options.neighbors) {
    built->warnings.push_back(Sentence("the graph has only ",
                                       num_nodes,
                                       num_nodes == 1 ? " node" : " nodes",
                                       " for ",
                                       plan.options.neighbors,
                                       " neighbours a point: a smaller node_spacing gives more"));
  }
  if (plan.distance != DistanceRule::kSurface) return;
  const int parts = static_cast<int>(std::count_if(
      plan.topology.component_sizes.begin(), plan.topology.component_sizes.end(), [&](int size) {
        return size >= plan.options.min_component_points;
      }));
  if (num_nodes < parts) {
    built->warnings.push_back(
        Sentence(num_nodes,
                 " nodes are too few for the ",
                 parts,
                 " connected parts of the surface: some follow the nodes of others"));
  }
}

// Returns the distance between nodes, also if only their number was given.
double SpacingOf(const BuiltGraph& built) {
  return built.node_spacing > 0.0 ? built.node_spacing : SurfaceNodeSpacing(built.graph);
}

// Binds the pieces of the surface that have no node to all nodes around them.
void BindPiecesWithoutNodes(const PointCloud& cloud,
                            const SurfaceTopology& topology,
                            BuiltGraph* built) {
  if (built->graph.num_inner_nodes() == 0) return;
  std::vector<char> has_no_node(topology.num_components(), 1);
  for (const int point : built->node_points) has_no_node[topology.component[point]] = 0;
  BindPiecesInBody(
      cloud, topology, has_no_node, built->graph, built->binding.num_threads, &built->skinning);
}

}  // namespace

StatusOr<BuiltGraph> BuildGraph(const PointCloud& cloud,
                                const SurfaceTopology& topology,
                                const GraphOptions& options) {
  Status status = CheckInput(cloud, topology, options);
  if (!status.ok()) return status;
  BuiltGraph built;
  const SamplingPlan plan{
      cloud, topology, options, ChooseDistance(cloud, topology, options, &built.warnings)};
  // 1. Choose the points at which nodes are placed.
  if (options.node_spacing == 0.0 && options.target_nodes > 0) {
    built.node_points = SampleWithCount(plan, &built.node_spacing);
  } else {
    built.node_spacing = options.node_spacing > 0.0 ? options.node_spacing : AutomaticSpacing(plan);
    built.node_points = SampleWithSpacing(plan, built.node_spacing);
  }
  WarnAboutNodes(plan, &built);

  const auto stopped = [&options] { return options.should_stop && options.should_stop(); };
  const Status stop = Status::Error("stopped before the graph was built");
  if (stopped()) return stop;

  // 2. Bind all points to the nodes (Eq. 2).
  built.binding = {options.neighbors, plan.distance, options.num_threads};
  built.skinning =
      BindPoints(cloud, topology, built.node_points, built.binding, options.should_stop);
  if (stopped()) return stop;

  // 3. Link nodes by the edges of E_reg (Eq. 6).
  for (const int point : built.node_points) built.graph.AddNode(cloud.points[point]);
  const std::vector<GraphEdge> edges =
      options.edges == EdgeRule::kSharedInfluence
          ? SharedInfluenceEdges(built.skinning, built.graph.num_nodes(), options.edges_per_node)
          : NearestNodeEdges(
                cloud, topology, built.node_points, options.edges_per_node, plan.distance);
  for (const GraphEdge& edge : edges) built.graph.AddEdge(edge);

  // 4. Join pieces that are not connected.
  const std::vector<int> pieces = ConnectedPieces(built.graph);
  built.num_pieces = 1 + *std::max_element(pieces.begin(), pieces.end());
  if (built.num_pieces > 1 && options.join_pieces)
    JoinPieces(&built.graph, options.edges_per_joint);
  built.num_surface_edges = built.graph.num_edges();

  // 5. Fill the body. Small pieces without nodes follow what is around them.
  if (options.volume && plan.distance == DistanceRule::kSurface) {
    AddVolume(cloud, built.node_points, SpacingOf(built), options.volume_weight, &built.graph);
    BindPiecesWithoutNodes(cloud, topology, &built);
  }
  if (built.num_pieces == 1) return built;
  built.warnings.push_back(Sentence("the graph is in ",
                                    built.num_pieces,
                                    " pieces",
                                    options.join_pieces ? ", joined where they are nearest" : ""));
  return built;
}

StatusOr<BuiltGraph> BuildGraph(const PointCloud& cloud, const GraphOptions& options) {
  // The check comes before the topology, which sorts the points.
  if (Status finite = CheckFinite(cloud); !finite.ok()) return finite;
  return BuildGraph(cloud, BuildTopology(cloud), options);
}

}  // namespace ceres_ed
