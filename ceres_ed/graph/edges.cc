#include "ceres_ed/graph/edges.h"

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/surface_distance.h>

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// The limits of an edge's weight as multiples of the mean weight.
constexpr double kMinRelativeWeight = 0.1;
constexpr double kMaxRelativeWeight = 10.0;

// A node that shares points with another one, and the sum of w_j w_k over these points.
struct Partner {
  int node;
  double influence;
};

// A possible edge between a piece and the nodes joined so far.
struct Candidate {
  double squared_distance;
  int piece_node;
  int joined_node;

  bool operator<(const Candidate& other) const {
    return std::tie(squared_distance, piece_node, joined_node) <
           std::tie(other.squared_distance, other.piece_node, other.joined_node);
  }
};

double MeanWeight(const std::vector<GraphEdge>& edges) {
  double sum = 0.0;
  for (const GraphEdge& edge : edges) sum += edge.weight;
  return sum / static_cast<double>(edges.size());
}

// Limits the weights to a range around their mean, and scales them to a mean of 1.
void NormalizeWeights(std::vector<GraphEdge>* edges) {
  if (edges->empty()) return;
  const double raw_mean = MeanWeight(*edges);
  for (GraphEdge& edge : *edges) {
    edge.weight = std::clamp(edge.weight / raw_mean, kMinRelativeWeight, kMaxRelativeWeight);
  }
  const double mean = MeanWeight(*edges);
  for (GraphEdge& edge : *edges) edge.weight /= mean;
}

// Returns the edges in both directions, sorted, each of them once. `kept` may contain an edge
// twice.
std::vector<GraphEdge> BothDirections(const std::vector<GraphEdge>& kept) {
  std::vector<GraphEdge> edges;
  edges.reserve(2 * kept.size());
  for (const GraphEdge& edge : kept) {
    edges.push_back(edge);
    edges.push_back({edge.to, edge.from, edge.weight});
  }
  std::sort(edges.begin(), edges.end(), [](const GraphEdge& a, const GraphEdge& b) {
    return a.from != b.from ? a.from < b.from : a.to < b.to;
  });
  const auto same = [](const GraphEdge& a, const GraphEdge& b) {
    return a.from == b.from && a.to == b.to;
  };
  edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
  return edges;
}

// Returns `count` of the sorted `candidates`: first those with two unused ends, then those with
// one, then the rest.
std::vector<Candidate> ChooseJoint(const std::vector<Candidate>& candidates, int count) {
  std::vector<Candidate> chosen;
  std::vector<char> taken(candidates.size(), 0);
  for (int shared_ends = 0; shared_ends <= 2; ++shared_ends) {
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (taken[i] || static_cast<int>(chosen.size()) >= count) continue;
      const Candidate& c = candidates[i];
      const auto has = [&chosen](int Candidate::*end, int node) {
        return std::any_of(chosen.begin(), chosen.end(), [&](const Candidate& other) {
          return other.*end == node;
        });
      };
      const int shared = (has(&Candidate::piece_node, c.piece_node) ? 1 : 0) +
                         (has(&Candidate::joined_node, c.joined_node) ? 1 : 0);
      if (shared > shared_ends) continue;
      chosen.push_back(c);
      taken[i] = 1;
    }
  }
  return chosen;
}

// Returns near pairs between the nodes of a piece and the nodes joined so far: from the `count`
// nodes of the piece that are nearest to the joined ones, to the `count` nearest joined nodes.
std::vector<Candidate> JointCandidates(const DeformationGraph& graph,
                                       std::vector<int> piece,
                                       const std::vector<int>& joined,
                                       const std::vector<double>& squared_to_joined,
                                       int count) {
  std::sort(piece.begin(), piece.end(), [&](int a, int b) {
    return std::tie(squared_to_joined[a], a) < std::tie(squared_to_joined[b], b);
  });
  piece.resize(std::min<std::size_t>(piece.size(), count));
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(joined.size());
  for (const int node : joined) positions.push_back(graph.position(node));
  const KdTree tree(positions);
  std::vector<Candidate> candidates;
  std::vector<Neighbor> nearest;
  for (const int node : piece) {
    tree.KNearest(graph.position(node), count, &nearest);
    for (const Neighbor& n : nearest) {
      candidates.push_back({n.squared_distance, node, joined[n.index]});
    }
  }
  std::sort(candidates.begin(), candidates.end());
  return candidates;
}

}  // namespace

std::vector<GraphEdge> SharedInfluenceEdges(const Skinning& skinning,
                                            int num_nodes,
                                            int edges_per_node) {
  CHECK_GE(edges_per_node, 1);
  // A node has a few dozen partners at most, so a list is faster than a map.
  std::vector<std::vector<Partner>> partners(num_nodes);
  const auto add = [&partners](int node, int other, double influence) {
    for (Partner& partner : partners[node]) {
      if (partner.node != other) continue;
      partner.influence += influence;
      return;
    }
    partners[node].push_back({other, influence});
  };
  // alpha_jk is the sum of w_j(v) w_k(v) over all points v, up to a common factor.
  for (std::size_t p = 0; p < skinning.size(); ++p) {
    const Binding binding = skinning[p];
    for (int i = 0; i < binding.size; ++i) {
      for (int k = i + 1; k < binding.size; ++k) {
        const double influence = binding.weights[i] * binding.weights[k];
        add(binding.nodes[i], binding.nodes[k], influence);
        add(binding.nodes[k], binding.nodes[i], influence);
      }
    }
  }
  std::vector<GraphEdge> kept;
  for (int node = 0; node < num_nodes; ++node) {
    std::vector<Partner>& list = partners[node];
    std::sort(list.begin(), list.end(), [](const Partner& a, const Partner& b) {
      return a.influence != b.influence ? a.influence > b.influence : a.node < b.node;
    });
    list.resize(std::min<std::size_t>(list.size(), edges_per_node));
    for (const Partner& partner : list) kept.push_back({node, partner.node, partner.influence});
  }
  std::vector<GraphEdge> edges = BothDirections(kept);
  NormalizeWeights(&edges);
  return edges;
}

std::vector<GraphEdge> NearestNodeEdges(const PointCloud& cloud,
                                        const SurfaceTopology& topology,
                                        const std::vector<int>& node_points,
                                        int edges_per_node,
                                        DistanceRule distance) {
  CHECK_GE(edges_per_node, 1);
  const int num_nodes = static_cast<int>(node_points.size());
  std::vector<GraphEdge> kept;
  if (distance == DistanceRule::kSurface && topology.HasSurface()) {
    const NearestSeeds nearest =
        NearestSeedsAlongSurface(topology, node_points, edges_per_node + 1);
    for (int node = 0; node < num_nodes; ++node) {
      const int* others = nearest.SeedsOf(node_points[node]);
      const int count = nearest.Count(node_points[node]);
      for (int i = 0; i < count; ++i) {
        if (others[i] != node) kept.push_back({node, others[i], 1.0});
      }
    }
    return BothDirections(kept);
  }
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(num_nodes);
  for (const int point : node_points) positions.push_back(cloud.points[point]);
  const KdTree tree(positions);
  std::vector<Neighbor> nearest;
  for (int node = 0; node < num_nodes; ++node) {
    tree.KNearest(positions[node], edges_per_node + 1, &nearest);
    for (const Neighbor& other : nearest) {
      if (other.index != node) kept.push_back({node, other.index, 1.0});
    }
  }
  return BothDirections(kept);
}

std::vector<int> ConnectedPieces(const DeformationGraph& graph) {
  std::vector<int> piece(graph.num_nodes(), -1);
  int num_pieces = 0;
  std::vector<int> stack;
  for (int start = 0; start < graph.num_nodes(); ++start) {
    if (piece[start] >= 0) continue;
    piece[start] = num_pieces;
    stack.assign(1, start);
    while (!stack.empty()) {
      const int node = stack.back();
      stack.pop_back();
      for (const int e : graph.incident_edges(node)) {
        const GraphEdge& edge = graph.edges()[e];
        const int other = edge.from == node ? edge.to : edge.from;
        if (piece[other] >= 0) continue;
        piece[other] = num_pieces;
        stack.push_back(other);
      }
    }
    ++num_pieces;
  }
  return piece;
}

int JoinPieces(DeformationGraph* graph, int edges_per_joint) {
  CHECK_GE(edges_per_joint, 1);
  const std::vector<int> piece_of = ConnectedPieces(*graph);
  std::vector<std::vector<int>> pieces;
  for (int node = 0; node < graph->num_nodes(); ++node) {
    if (piece_of[node] == static_cast<int>(pieces.size())) pieces.emplace_back();
    pieces[piece_of[node]].push_back(node);
  }
  if (pieces.size() <= 1) return static_cast<int>(pieces.size());
  const auto largest =
      std::max_element(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) {
        return a.size() < b.size();
      });
  int next = static_cast<int>(largest - pieces.begin());
  std::vector<char> is_joined(pieces.size(), 0);
  std::vector<int> joined;
  std::vector<double> squared_to_joined(graph->num_nodes(),
                                        std::numeric_limits<double>::infinity());
  // Prim's algorithm over pieces: each node outside stores its distance to the nearest node inside.
  while (true) {
    is_joined[next] = 1;
    joined.insert(joined.end(), pieces[next].begin(), pieces[next].end());
    int nearest = -1;
    for (int node = 0; node < graph->num_nodes(); ++node) {
      if (is_joined[piece_of[node]]) continue;
      for (const int other : pieces[next]) {
        squared_to_joined[node] =
            std::min(squared_to_joined[node],
                     (graph->position(node) - graph->position(other)).squaredNorm());
      }
      if (nearest < 0 || squared_to_joined[node] < squared_to_joined[nearest]) nearest = node;
    }
    if (nearest < 0) return static_cast<int>(pieces.size());
    next = piece_of[nearest];
    const std::vector<Candidate> candidates =
        JointCandidates(*graph, pieces[next], joined, squared_to_joined, edges_per_joint);
    for (const Candidate& c : ChooseJoint(candidates, edges_per_joint)) {
      graph->AddEdge({c.joined_node, c.piece_node, 1.0});
      graph->AddEdge({c.piece_node, c.joined_node, 1.0});
    }
  }
}

int CarryPieces(const std::vector<int>& piece,
                const std::vector<char>& is_carried,
                int edges_per_node,
                double reach,
                DeformationGraph* graph) {
  CHECK_EQ(static_cast<int>(piece.size()), graph->num_nodes());
  std::set<std::pair<int, int>> linked;
  for (const GraphEdge& edge : graph->edges()) linked.insert(std::minmax(edge.from, edge.to));
  const std::size_t before = linked.size();
  std::vector<std::pair<double, int>> others;
  for (int j = 0; j < graph->num_nodes(); ++j) {
    if (is_carried[piece[j]] == 0) continue;
    others.clear();
    for (int k = 0; k < graph->num_nodes(); ++k) {
      const double distance = (graph->position(j) - graph->position(k)).norm();
      if (piece[k] != piece[j] && distance <= reach) others.emplace_back(distance, k);
    }
    std::sort(others.begin(), others.end());
    if (static_cast<int>(others.size()) > edges_per_node) others.resize(edges_per_node);
    for (const auto& [distance, k] : others) {
      if (!linked.insert(std::minmax(j, k)).second) continue;
      graph->AddEdge({j, k, 1.0});
      graph->AddEdge({k, j, 1.0});
    }
  }
  return static_cast<int>(linked.size() - before);
}

}  // namespace ceres_ed
