// A set of nodes. The time of its functions does not depend on the size of the graph.
#ifndef CERES_ED_GRAPH_NODE_SET_H_
#define CERES_ED_GRAPH_NODE_SET_H_

#include <ceres_ed/util/memory_use.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ceres_ed {

// A set that has a mark for each node and a list of its members. Looking up and adding a node take
// constant time; Clear() takes time in proportion to the members.
class NodeSet {
 public:
  // Returns whether `node` is in the set.
  bool Has(int node) const {
    return static_cast<std::size_t>(node) < marks_.size() && marks_[node] != 0;
  }

  // Adds a node. Returns false if it was in the set already.
  bool Add(int node) {
    if (static_cast<std::size_t>(node) >= marks_.size()) {
      marks_.resize(static_cast<std::size_t>(node) + 1, 0);
    }
    if (marks_[node] != 0) return false;
    marks_[node] = 1;
    nodes_.push_back(node);
    return true;
  }

  // Removes all nodes.
  void Clear() {
    for (const int node : nodes_) marks_[node] = 0;
    nodes_.clear();
  }

  // The members in the order in which they were added; after Sort(), in ascending order.
  const std::vector<int>& nodes() const { return nodes_; }
  int size() const { return static_cast<int>(nodes_.size()); }
  bool empty() const { return nodes_.empty(); }
  void Sort() { std::sort(nodes_.begin(), nodes_.end()); }
  // The memory on the heap, in bytes.
  std::size_t HeapBytes() const { return HeapBytesOf(marks_) + HeapBytesOf(nodes_); }

 private:
  std::vector<char> marks_;
  std::vector<int> nodes_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_NODE_SET_H_
