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

// A directed edge (j, k) of E_reg (Eq. 6): node `from` = j predicts where node `to` = k goes.
struct GraphEdge {
  int from = -1;
  int to = -1;
  // alpha_jk >= 0, no unit.
  double weight = 1.0;
};

// Nodes g_j and directed edges. Node indices are stable: nodes are only ever appended, and none
// that is there is copied for it.
class DeformationGraph {
 public:
  int num_nodes() const { return static_cast<int>(positions_.size()); }
  int num_edges() const { return static_cast<int>(edges_.size()); }

  // g_j in map units.
  const Eigen::Vector3d& position(int node) const { return positions_[node]; }
  const std::deque<Eigen::Vector3d>& positions() const { return positions_; }
  const std::deque<GraphEdge>& edges() const { return edges_; }
  // Indices into edges() of every edge that leaves or enters `node`.
  const std::vector<int>& incident_edges(int node) const { return incident_edges_[node]; }

  // Returns the new node's index.
  int AddNode(const Eigen::Vector3d& position) {
    positions_.push_back(position);
    incident_edges_.emplace_back();
    return num_nodes() - 1;
  }

  // Returns the new edge's index. Both nodes must be there and differ.
  int AddEdge(const GraphEdge& edge) {
    CHECK(edge.from >= 0 && edge.from < num_nodes()) << "edge from " << edge.from;
    CHECK(edge.to >= 0 && edge.to < num_nodes() && edge.to != edge.from) << "edge to " << edge.to;
    const int index = num_edges();
    edges_.push_back(edge);
    PushBackTightly(index, &incident_edges_[edge.from]);
    PushBackTightly(index, &incident_edges_[edge.to]);
    return index;
  }

  // Of the nodes alone, and of the edges with the lists of incident ones.
  std::size_t NodeHeapBytes() const { return HeapBytesOf(positions_); }
  std::size_t EdgeHeapBytes() const {
    return HeapBytesOf(edges_) + HeapBytesOfAll(incident_edges_);
  }

 private:
  std::deque<Eigen::Vector3d> positions_;
  std::deque<GraphEdge> edges_;
  std::deque<std::vector<int>> incident_edges_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_DEFORMATION_GRAPH_H_
