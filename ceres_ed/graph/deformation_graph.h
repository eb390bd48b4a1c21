// The embedded-deformation graph: node positions and the edges between them (paper, section II).
#ifndef CERES_ED_GRAPH_DEFORMATION_GRAPH_H_
#define CERES_ED_GRAPH_DEFORMATION_GRAPH_H_

#include <ceres_ed/util/memory_use.h>

#include <cstddef>
#include <deque>
#include <vector>

#include <Eigen/Core>
#include <glog/logging.h>

namespace ceres_ed {

// A directed edge (j, k) of E_reg (Eq. 6): node `from` = j predicts the position of node `to` = k.
struct GraphEdge {
  int from = -1;
  int to = -1;
  // alpha_jk >= 0, without a unit.
  double weight = 1.0;
};

// The nodes g_j and the directed edges between them. Node indices are stable: nodes are only ever
// appended, and adding one does not copy the others. A graph of a body has nodes on its surface,
// and behind them nodes inside; points of the surface are bound to the first ones only.
class DeformationGraph {
 public:
  int num_nodes() const { return static_cast<int>(positions_.size()); }
  // The number of nodes that are not inside a body; all others follow them.
  int num_surface_nodes() const { return num_nodes() - num_inner_nodes_; }
  int num_inner_nodes() const { return num_inner_nodes_; }
  int num_edges() const { return static_cast<int>(edges_.size()); }

  // The rest positions g_j, in map units.
  const Eigen::Vector3d& position(int node) const { return positions_[node]; }
  const std::deque<Eigen::Vector3d>& positions() const { return positions_; }
  const std::deque<GraphEdge>& edges() const { return edges_; }
  // The indices into edges() of all edges that leave or enter `node`.
  const std::vector<int>& incident_edges(int node) const { return incident_edges_[node]; }

  // Adds a node at `position` (map units) and returns its index.
  int AddNode(const Eigen::Vector3d& position) {
    CHECK_EQ(num_inner_nodes_, 0) << "nodes of the surface come before inner ones";
    return Append(position);
  }

  // Adds a node inside the body and returns its index. No other nodes may be added after it.
  int AddInnerNode(const Eigen::Vector3d& position) {
    ++num_inner_nodes_;
    return Append(position);
  }

  // Adds an edge and returns its index. Fails a CHECK unless both nodes exist and differ.
  int AddEdge(const GraphEdge& edge) {
    CHECK(edge.from >= 0 && edge.from < num_nodes()) << "edge from " << edge.from;
    CHECK(edge.to >= 0 && edge.to < num_nodes() && edge.to != edge.from) << "edge to " << edge.to;
    const int index = num_edges();
    edges_.push_back(edge);
    PushBackTightly(index, &incident_edges_[edge.from]);
    PushBackTightly(index, &incident_edges_[edge.to]);
    return index;
  }

  // Sets the weight of an edge, >= 0.
  void SetEdgeWeight(int edge, double weight) { edges_[edge].weight = weight; }

  // The memory on the heap, in bytes: of the node positions, and of the edges with the lists of
  // incident edges.
  std::size_t NodeHeapBytes() const { return HeapBytesOf(positions_); }
  std::size_t EdgeHeapBytes() const {
    return HeapBytesOf(edges_) + HeapBytesOfAll(incident_edges_);
  }

 private:
  int Append(const Eigen::Vector3d& position) {
    positions_.push_back(position);
    incident_edges_.emplace_back();
    return num_nodes() - 1;
  }

  int num_inner_nodes_ = 0;
  std::deque<Eigen::Vector3d> positions_;
  std::deque<GraphEdge> edges_;
  std::deque<std::vector<int>> incident_edges_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_DEFORMATION_GRAPH_H_
