// A set of nodes that costs what is in it, not what the graph has.
#ifndef CERES_ED_GRAPH_NODE_SET_H_
#define CERES_ED_GRAPH_NODE_SET_H_

#include <ceres_ed/util/memory_use.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ceres_ed {

// Marks and a list: looking up, adding and emptying cost nothing for the nodes outside.
class NodeSet {
 public:
  bool Has(int node) const {
    return static_cast<std::size_t>(node) < marks_.size() && marks_[node] != 0;
  }

  // False when it was there already.
  bool Add(int node) {
    if (static_cast<std::size_t>(node) >= marks_.size()) {
      marks_.resize(static_cast<std::size_t>(node) + 1, 0);
    }
    if (marks_[node] != 0) return false;
    marks_[node] = 1;
    nodes_.push_back(node);
    return true;
  }

  void Clear() {
    for (const int node : nodes_) marks_[node] = 0;
    nodes_.clear();
  }

  // In the order in which they were added, or by number after Sort().
  const std::vector<int>& nodes() const { return nodes_; }
  int size() const { return static_cast<int>(nodes_.size()); }
  bool empty() const { return nodes_.empty(); }
  void Sort() { std::sort(nodes_.begin(), nodes_.end()); }
  std::size_t HeapBytes() const { return HeapBytesOf(marks_) + HeapBytesOf(nodes_); }

 private:
  std::vector<char> marks_;
  std::vector<int> nodes_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_NODE_SET_H_
