// A tree of boxes, four to a node, that is searched with vector instructions.
#ifndef CERES_ED_GEOMETRY_BOX_TREE_H_
#define CERES_ED_GEOMETRY_BOX_TREE_H_

#include <ceres_ed/util/lanes.h>

#include <limits>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

struct BoxTreeItem;

// Items (triangles) in leaves of at most `leaf_size`, under nodes of at most four boxes. A box need
// only be no smaller than what is in it.
class BoxTree {
 public:
  static constexpr int kWidth = kLanes;

  struct Box {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Vector3d high = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());

    // Coordinates that are not a number are left out.
    void Extend(const Eigen::Vector3d& point) {
      for (int axis = 0; axis < 3; ++axis) {
        if (point[axis] < low[axis]) low[axis] = point[axis];
        if (point[axis] > high[axis]) high[axis] = point[axis];
      }
    }
  };

  // `centers` has a point for every item, by which they are divided. Boxes are empty until Fit().
  BoxTree(const std::vector<Eigen::Vector3d>& centers, int leaf_size);

  // Leaf i has the items order()[i * leaf_size] to order()[(i + 1) * leaf_size]; the last leaf may
  // have fewer.
  const std::vector<int>& order() const { return order_; }
  int num_leaves() const { return (static_cast<int>(order_.size()) + leaf_size_ - 1) / leaf_size_; }

  // Makes all boxes fit; `boxes` has one a leaf.
  void Fit(const std::vector<Box>& boxes);

  // Calls visitor->Leaf(i) for every leaf whose box is at most sqrt(visitor->bound()) away from
  // `query`, near ones first; the bound may shrink meanwhile. A little farther ones may be among
  // them: rounding hides none that is equally near. Meant to be inlined into a function for each
  // machine.
  template <typename Visitor>
  [[gnu::always_inline]] inline void Visit(const Eigen::Vector3d& query, Visitor* visitor) const;

 private:
  // A child is a node, or a leaf as ~leaf.
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
  // The root is the first one; none where there is no item.
  std::vector<Node> nodes_;
};

template <typename Visitor>
inline void BoxTree::Visit(const Eigen::Vector3d& query, Visitor* visitor) const {
  constexpr double kSlack = 1.0 - 1e-12;
  // Four children a level at most, and leaves are divided evenly: 16 levels hold 2^32 leaves.
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
      // At most one of both is positive.
      const Lanes gap = Where(below > 0.0, below) + Where(above > 0.0, above);
      squared += gap * gap;
    }
    squared *= kSlack;
    // The nearest on top.
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
