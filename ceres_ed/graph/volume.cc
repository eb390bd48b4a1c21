#include "ceres_ed/graph/volume.h"

#include <ceres_ed/geometry/inside_grid.h>
#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/normals.h>
#include <ceres_ed/geometry/triangle_area.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <Eigen/Core>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

// The cells of the grid that tells inside from outside, per node spacing.
constexpr double kCellsPerSpacing = 6.0;
// In node spacings: the distance between inner nodes, the least distance of an inner node from a
// node of the surface, and the longest edges of inner nodes and between nodes of the surface.
constexpr double kInnerPitch = 1.0;
constexpr double kMinDepth = 0.8;
constexpr double kInnerReach = 1.25;
constexpr double kFacingReach = 2.0;
// The weight of an edge between nodes that face each other.
constexpr double kFacingWeight = 1.0;
// Two nodes face each other if the angle between the line that joins them and the normal is less
// than 60 degrees at both, and the normals point to opposite sides.
constexpr double kMinFacingCosine = 0.5;
// The largest square of the length of all borders of a closed surface, as a part of its area.
constexpr double kMaxBorder = 0.05;

std::vector<Eigen::Vector3d> Positions(const DeformationGraph& graph) {
  return {graph.positions().begin(), graph.positions().end()};
}

// Adds the inner nodes.
void AddInnerNodes(const InsideGrid& inside, double spacing, DeformationGraph* graph) {
  const std::vector<Eigen::Vector3d> on_surface = Positions(*graph);
  const KdTree surface(on_surface);
  const double pitch = kInnerPitch * spacing;
  const Eigen::Vector3d extent = inside.Extent();
  const Eigen::Vector3i count = (extent / pitch).array().ceil().cast<int>();
  // The grid of nodes is centred on the body.
  const Eigen::Vector3d first =
      inside.origin() + 0.5 * extent - 0.5 * pitch * (count.cast<double>().array() - 1.0).matrix();
  for (int z = 0; z < count.z(); ++z) {
    for (int y = 0; y < count.y(); ++y) {
      for (int x = 0; x < count.x(); ++x) {
        const Eigen::Vector3d point = first + pitch * Eigen::Vector3d(x, y, z);
        if (!inside.IsInside(point)) continue;
        const double depth = std::sqrt(surface.Nearest(point).squared_distance);
        if (depth >= kMinDepth * spacing) graph->AddInnerNode(point);
      }
    }
  }
}

// Decides which nodes are joined through the body.
class BodyEdges {
 public:
  BodyEdges(const PointCloud& cloud,
            const std::vector<int>& node_points,
            const InsideGrid& inside,
            double spacing,
            const DeformationGraph& graph)
      : inside_(inside),
        spacing_(spacing),
        num_surface_(graph.num_surface_nodes()),
        positions_(Positions(graph)),
        tree_(positions_) {
    const std::vector<Eigen::Vector3d> normals =
        cloud.HasNormals() ? cloud.normals : ComputeVertexNormals(cloud);
    for (const int point : node_points) normals_.push_back(normals[point]);
    for (const GraphEdge& edge : graph.edges()) linked_.insert(std::minmax(edge.from, edge.to));
  }

  // Returns the nodes behind `node` in the list of nodes to which it gets an edge, in ascending
  // order.
  std::vector<int> PartnersOf(int node) const {
    std::vector<Neighbor> near;
    tree_.RadiusSearch(positions_[node], std::max(kInnerReach, kFacingReach) * spacing_, &near);
    std::vector<int> partners;
    for (const Neighbor& other : near) {
      if (other.index <= node) continue;
      if (IsJoined(node, other.index, std::sqrt(other.squared_distance))) {
        partners.push_back(other.index);
      }
    }
    std::sort(partners.begin(), partners.end());
    return partners;
  }

 private:
  bool IsJoined(int node, int other, double length) const {
    if (length > (other < num_surface_ ? kFacingReach : kInnerReach) * spacing_) return false;
    if (other < num_surface_ && (linked_.count({node, other}) > 0 || !Face(node, other))) {
      return false;
    }
    return inside_.IsSegmentInside(positions_[node], positions_[other]);
  }

  // Returns whether two nodes of the surface look at each other, through the body or around it. The
  // surface may be wound inside out.
  bool Face(int a, int b) const {
    const Eigen::Vector3d line = (positions_[b] - positions_[a]).normalized();
    const double at_a = normals_[a].dot(line);
    const double at_b = normals_[b].dot(line);
    return at_a * at_b < 0.0 && std::min(std::abs(at_a), std::abs(at_b)) >= kMinFacingCosine;
  }

  const InsideGrid& inside_;
  const double spacing_;
  const int num_surface_;
  const std::vector<Eigen::Vector3d> positions_;
  const KdTree tree_;
  std::vector<Eigen::Vector3d> normals_;
  std::set<std::pair<int, int>> linked_;
};

}  // namespace

bool EnclosesBody(const PointCloud& cloud, const SurfaceTopology& topology) {
  // Each edge is a link of both of its ends.
  double border = 0.0;
  for (std::size_t e = 0; e < topology.edges.size(); ++e) {
    if (topology.edge_is_border[e] != 0) border += 0.5 * topology.edges[e].length;
  }
  return border * border < kMaxBorder * SurfaceArea(cloud.points, cloud.triangles);
}

int AddVolume(const PointCloud& cloud,
              const std::vector<int>& node_points,
              double wanted_spacing,
              double weight,
              DeformationGraph* graph) {
  CHECK_GT(wanted_spacing, 0.0);
  CHECK_EQ(static_cast<int>(node_points.size()), graph->num_nodes());
  // A coarse mesh has no room for nodes that are as near to each other as was wanted. Without a
  // bound the body would get any number of them.
  constexpr double kFinest = 0.5;
  const double area_of_node =
      SurfaceArea(cloud.points, cloud.triangles) / std::max(1, graph->num_nodes());
  const double spacing = std::max(wanted_spacing, kFinest * std::sqrt(area_of_node));
  const InsideGrid inside(cloud, spacing / kCellsPerSpacing);
  AddInnerNodes(inside, spacing, graph);
  const int num_surface = graph->num_surface_nodes();
  const int before = graph->num_edges();
  const BodyEdges edges(cloud, node_points, inside, spacing, *graph);
  for (int j = 0; j < graph->num_nodes(); ++j) {
    for (const int k : edges.PartnersOf(j)) {
      const double alpha = k < num_surface ? kFacingWeight : weight;
      graph->AddEdge({j, k, alpha});
      graph->AddEdge({k, j, alpha});
    }
  }
  return graph->num_edges() - before;
}

}  // namespace ceres_ed
