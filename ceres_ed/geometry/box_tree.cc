#include "ceres_ed/geometry/box_tree.h"

#include <algorithm>
#include <cmath>

#include <glog/logging.h>

namespace ceres_ed {

struct BoxTreeItem {
  double at[3];
  int index;
};

namespace {

// Returns the axis along which the items extend farthest.
int WidestAxis(const BoxTreeItem* first, const BoxTreeItem* last) {
  std::array<double, 3> low = {first->at[0], first->at[1], first->at[2]};
  std::array<double, 3> high = low;
  for (const BoxTreeItem* item = first + 1; item != last; ++item) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], item->at[axis]);
      high[axis] = std::max(high[axis], item->at[axis]);
    }
  }
  int widest = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (high[axis] - low[axis] > high[widest] - low[widest]) widest = axis;
  }
  return widest;
}

// Moves the items so that those before `middle` come first along the widest axis.
void DivideAt(BoxTreeItem* first, BoxTreeItem* middle, BoxTreeItem* last) {
  const int axis = WidestAxis(first, last);
  std::nth_element(first, middle, last, [axis](const BoxTreeItem& a, const BoxTreeItem& b) {
    return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.index < b.index;
  });
}

}  // namespace

BoxTree::BoxTree(const std::vector<Eigen::Vector3d>& centers, int leaf_size)
    : leaf_size_(leaf_size), order_(centers.size()) {
  CHECK_GE(leaf_size, 1);
  if (centers.empty()) return;
  std::vector<BoxTreeItem> items(centers.size());
  for (std::size_t i = 0; i < centers.size(); ++i) {
    items[i].index = static_cast<int>(i);
    // A value that is not a number can't be sorted.
    for (int axis = 0; axis < 3; ++axis) {
      items[i].at[axis] = std::isfinite(centers[i][axis]) ? centers[i][axis] : 0.0;
    }
  }
  nodes_.reserve(num_leaves() / (kWidth - 1) + 1);
  Divide(0, num_leaves(), items.data());
  for (std::size_t i = 0; i < items.size(); ++i) order_[i] = items[i].index;
}

// Divides the leaves evenly among up to four children: by the median, and each half by its median.
int BoxTree::Divide(int first_leaf, int last_leaf, BoxTreeItem* items) {
  const int node = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  const int size = static_cast<int>(order_.size());
  const auto at = [&](int leaf) { return items + std::min(leaf * leaf_size_, size); };
  std::array<int, kWidth + 1> bounds = {first_leaf, first_leaf, last_leaf, last_leaf, last_leaf};
  const int middle = first_leaf + (last_leaf - first_leaf) / 2;
  bounds[1] = first_leaf + (middle - first_leaf) / 2;
  bounds[2] = middle;
  bounds[3] = middle + (last_leaf - middle) / 2;
  if (middle > first_leaf) DivideAt(at(first_leaf), at(middle), at(last_leaf));
  if (bounds[1] > first_leaf) DivideAt(at(first_leaf), at(bounds[1]), at(middle));
  if (bounds[3] > middle) DivideAt(at(middle), at(bounds[3]), at(last_leaf));
  for (int i = 0; i < kWidth; ++i) {
    const int count = bounds[i + 1] - bounds[i];
    if (count == 0) continue;
    const int child = count == 1 ? ~bounds[i] : Divide(bounds[i], bounds[i + 1], items);
    nodes_[node].child[nodes_[node].num_children++] = child;
  }
  return node;
}

void BoxTree::SetBox(Node* node, int place, const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    node->low[axis][place] = box.low[axis];
    node->high[axis][place] = box.high[axis];
  }
}

// Sets the boxes of a node's children, from the leaves up, and returns the box of the node.
BoxTree::Box BoxTree::FitNode(int node, const std::vector<Box>& boxes) {
  Box all;
  for (int i = 0; i < kWidth; ++i) {
    Box box;
    if (i < nodes_[node].num_children) {
      const int child = nodes_[node].child[i];
      box = child < 0 ? boxes[~child] : FitNode(child, boxes);
      all.low = all.low.cwiseMin(box.low);
      all.high = all.high.cwiseMax(box.high);
    }
    SetBox(&nodes_[node], i, box);
  }
  return all;
}

void BoxTree::Fit(const std::vector<Box>& boxes) {
  CHECK_EQ(static_cast<int>(boxes.size()), num_leaves());
  if (!nodes_.empty()) FitNode(0, boxes);
}

}  // namespace ceres_ed
