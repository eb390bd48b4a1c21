// A tree of boxes with four boxes in each node, which is searched with vector instructions.
#ifndef CERES_ED_GEOMETRY_BOX_TREE_H_
#define CERES_ED_GEOMETRY_BOX_TREE_H_

#include <ceres_ed/util/lanes.h>

#include <limits>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

struct BoxTreeItem;

// A tree over items (triangles). Each leaf has at most `leaf_size` items, and each inner node has
// at most four children, each with a box. A box must contain everything below it; it may be larger.
class BoxTree {
 public:
  static constexpr int kWidth = kLanes;

  // A box with sides along the axes. It is empty by default.
  struct Box {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Vector3d high = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());

    // Makes the box contain `point`. Coordinates that are not a number are ignored.
    void Extend(const Eigen::Vector3d& point) {
      for (int axis = 0; axis < 3; ++axis) {
        if (point[axis] < low[axis]) low[axis] = point[axis];
        if (point[axis] > high[axis]) high[axis] = point[axis];
      }
    }
  };

  // Builds the tree. `centers` has one point for each item, by which the items are divided. All
  // boxes are empty until Fit() is called.
  BoxTree(const std::vector<Eigen::Vector3d>& centers, int leaf_size);

  // The items by leaf: leaf i has the items order()[i * leaf_size] to order()[(i + 1) * leaf_size].
  // The last leaf may have fewer.
  const std::vector<int>& order() const { return order_; }
  int num_leaves() const { return (static_cast<int>(order_.size()) + leaf_size_ - 1) / leaf_size_; }

  // Sets all boxes of the tree. `boxes` has one box for each leaf.
  void Fit(const std::vector<Box>& boxes);

  // Calls visitor->Leaf(i) for every leaf whose box is at most sqrt(visitor->bound()) away from
  // `query`, near leaves first. The bound may shrink during the search. Leaves that are slightly
  // farther away may be visited, too, so that rounding never hides a leaf that is equally near. The
  // function is meant to be inlined into a function that is compiled for each machine (see
  // for_each_machine.h).
  template <typename Visitor>
  [[gnu::always_inline]] inline void Visit(const Eigen::Vector3d& query, Visitor* visitor) const;

 private:
  // A child is the index of a node, or ~leaf for a leaf.
  struct Node {
    Lanes low[3];
    Lanes high[3];
    int child[kWidth];
    int num_children = 0;
  };

  int Divide(int first_leaf, int last_leaf, BoxTreeItem* items);
  void SetBox(Node* node, int place, const Box& box);
  Box FitNode(int node, const std::vector<Box>& boxes);

  int leaf_size_;
  std::vector<int> order_;
  // The first node is the root. The list is empty if there are no items.
  std::vector<Node> nodes_;
};

template <typename Visitor>
inline void BoxTree::Visit(const Eigen::Vector3d& query, Visitor* visitor) const {
  constexpr double kSlack = 1.0 - 1e-12;
  // A level has at most four children, and leaves are divided evenly, so 16 levels hold 2^32
  // leaves.
  constexpr int kMaxPending = (kWidth - 1) * 17 + 1;
  struct Pending {
    double squared_distance;
    int child;
  };
  if (nodes_.empty()) return;
  Pending stack[kMaxPending];
  int size = 0;
  stack[size++] = {0.0, 0};
  while (size > 0) {
    const Pending top = stack[--size];
    if (top.squared_distance > visitor->bound()) continue;
    if (top.child < 0) {
      visitor->Leaf(~top.child);
      continue;
    }
    const Node& node = nodes_[top.child];
    Lanes squared = {0.0, 0.0, 0.0, 0.0};
    for (int axis = 0; axis < 3; ++axis) {
      const Lanes below = node.low[axis] - query[axis];
      const Lanes above = query[axis] - node.high[axis];
      // At most one of the two is positive.
      const Lanes gap = Where(below > 0.0, below) + Where(above > 0.0, above);
      squared += gap * gap;
    }
    squared *= kSlack;
    // Put the children on the stack so that the nearest is on top.
    const int bottom = size;
    for (int i = 0; i < node.num_children; ++i) {
      if (squared[i] > visitor->bound()) continue;
      int place = size++;
      for (; place > bottom && stack[place - 1].squared_distance < squared[i]; --place) {
        stack[place] = stack[place - 1];
      }
      stack[place] = {squared[i], node.child[i]};
    }
  }
}

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_BOX_TREE_H_
