#include "ceres_ed/geometry/kd_tree.h"

#include <ceres_ed/geometry/box_tree.h>
#include <ceres_ed/util/for_each_machine.h>

#include <algorithm>
#include <cstddef>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr int kLeafSize = 8;
// Distances of the machine's own are compared with a little slack: fused products round otherwise.
constexpr double kSlack = 1.0 - 1e-12;

// The points of a leaf side by side; places without a point are not a number.
struct PointLeaf {
  Lanes at[3][kLeafSize / kLanes];
  int index[kLeafSize];
};

bool Before(double distance_a, int index_a, const Neighbor& b) {
  return distance_a < b.squared_distance || (distance_a == b.squared_distance && index_a < b.index);
}

// What a search keeps of the points that it meets. All three prefer the lowest index of equally far
// points, so that the answer does not depend on the shape of the tree.
class NearestSet {
 public:
  explicit NearestSet(double squared_bound) : bound_(squared_bound) {}
  double bound() const { return bound_; }
  void Add(double squared_distance, int index) {
    if (!(squared_distance <= bound_)) return;
    if (best_.found() && !Before(squared_distance, index, best_)) return;
    best_ = {index, squared_distance};
    bound_ = squared_distance;
  }
  const Neighbor& best() const { return best_; }

 private:
  double bound_;
  Neighbor best_;
};

class KNearestSet {
 public:
  KNearestSet(Neighbor* out, int capacity) : out_(out), capacity_(capacity) {}
  double bound() const {
    return count_ < capacity_ ? std::numeric_limits<double>::infinity()
                              : out_[capacity_ - 1].squared_distance;
  }
  int count() const { return count_; }
  void Add(double squared_distance, int index) {
    if (count_ == capacity_ && !Before(squared_distance, index, out_[count_ - 1])) return;
    int i = count_ < capacity_ ? count_++ : capacity_ - 1;
    for (; i > 0 && Before(squared_distance, index, out_[i - 1]); --i) out_[i] = out_[i - 1];
    out_[i] = {index, squared_distance};
  }

 private:
  Neighbor* out_;
  int capacity_;
  int count_ = 0;
};

class RadiusSet {
 public:
  RadiusSet(double squared_radius, std::vector<Neighbor>* out)
      : squared_radius_(squared_radius), out_(out) {}
  double bound() const { return squared_radius_; }
  void Add(double squared_distance, int index) {
    if (squared_distance <= squared_radius_) out_->push_back({index, squared_distance});
  }

 private:
  double squared_radius_;
  std::vector<Neighbor>* out_;
};

// Adds a point of a leaf by its exact distance, the same on every machine.
template <typename Set>
[[gnu::noinline]] void AddPoint(
    const PointLeaf& leaf, int half, int lane, const Eigen::Vector3d& query, Set* set) {
  const double x = query.x() - leaf.at[0][half][lane];
  const double y = query.y() - leaf.at[1][half][lane];
  const double z = query.z() - leaf.at[2][half][lane];
  set->Add(x * x + y * y + z * z, leaf.index[half * kLanes + lane]);
}

template <typename Set>
struct LeafVisitor {
  const PointLeaf* leaves;
  const Eigen::Vector3d& query;
  Set* set;

  double bound() const { return set->bound(); }
  [[gnu::always_inline]] void Leaf(int i) {
    const PointLeaf& leaf = leaves[i];
    for (int half = 0; half < kLeafSize / kLanes; ++half) {
      const Lanes x = query[0] - leaf.at[0][half];
      const Lanes y = query[1] - leaf.at[1][half];
      const Lanes z = query[2] - leaf.at[2][half];
      const Lanes squared = kSlack * (x * x + y * y + z * z);
      for (int lane = 0; lane < kLanes; ++lane) {
        if (squared[lane] <= set->bound()) AddPoint(leaf, half, lane, query, set);
      }
    }
  }
};

CERES_ED_FOR_EACH_MACHINE
void Search(const BoxTree& tree,
            const PointLeaf* leaves,
            const Eigen::Vector3d& query,
            NearestSet* set) {
  LeafVisitor<NearestSet> visitor{leaves, query, set};
  tree.Visit(query, &visitor);
}

CERES_ED_FOR_EACH_MACHINE
void SearchMany(const BoxTree& tree,
                const PointLeaf* leaves,
                const Eigen::Vector3d& query,
                KNearestSet* set) {
  LeafVisitor<KNearestSet> visitor{leaves, query, set};
  tree.Visit(query, &visitor);
}

CERES_ED_FOR_EACH_MACHINE
void SearchAround(const BoxTree& tree,
                  const PointLeaf* leaves,
                  const Eigen::Vector3d& query,
                  RadiusSet* set) {
  LeafVisitor<RadiusSet> visitor{leaves, query, set};
  tree.Visit(query, &visitor);
}

}  // namespace

struct KdTree::Impl {
  explicit Impl(const std::vector<Eigen::Vector3d>& points)
      : points(points), tree(points, kLeafSize), leaves(tree.num_leaves()) {
    Fit();
  }

  void Fit() {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    std::vector<BoxTree::Box>& boxes = leaf_boxes;
    boxes.assign(leaves.size(), BoxTree::Box());
    const std::size_t places = leaves.size() * kLeafSize;
    for (std::size_t i = 0; i < places; ++i) {
      PointLeaf& leaf = leaves[i / kLeafSize];
      const int place = static_cast<int>(i % kLeafSize);
      leaf.index[place] = i < points.size() ? tree.order()[i] : -1;
      for (int axis = 0; axis < 3; ++axis) {
        leaf.at[axis][place / kLanes][place % kLanes] =
            i < points.size() ? points[leaf.index[place]][axis] : kNone;
      }
      if (i < points.size()) boxes[i / kLeafSize].Extend(points[leaf.index[place]]);
    }
    tree.Fit(boxes);
  }

  const std::vector<Eigen::Vector3d>& points;
  BoxTree tree;
  std::vector<PointLeaf> leaves;
  std::vector<BoxTree::Box> leaf_boxes;
};

KdTree::KdTree(const std::vector<Eigen::Vector3d>& points)
    : impl_(std::make_unique<Impl>(points)) {}
KdTree::~KdTree() = default;
KdTree::KdTree(KdTree&&) noexcept = default;
KdTree& KdTree::operator=(KdTree&&) noexcept = default;

void KdTree::Update() { impl_->Fit(); }

const std::vector<int>& KdTree::order() const { return impl_->tree.order(); }

Neighbor KdTree::Nearest(const Eigen::Vector3d& query) const {
  return NearestWithin(query, std::numeric_limits<double>::infinity());
}

Neighbor KdTree::NearestWithin(const Eigen::Vector3d& query, double max_distance, int hint) const {
  if (!(max_distance >= 0.0) || !query.allFinite()) return {};
  NearestSet result(max_distance * max_distance);
  if (hint >= 0) {
    const Eigen::Vector3d gap = query - impl_->points[hint];
    result.Add(gap.x() * gap.x() + gap.y() * gap.y() + gap.z() * gap.z(), hint);
  }
  Search(impl_->tree, impl_->leaves.data(), query, &result);
  return result.best();
}

int KdTree::KNearest(const Eigen::Vector3d& query, int k, Neighbor* out) const {
  CHECK_GE(k, 0);
  if (k == 0 || !query.allFinite()) return 0;
  KNearestSet result(out, k);
  SearchMany(impl_->tree, impl_->leaves.data(), query, &result);
  return result.count();
}

int KdTree::KNearest(const Eigen::Vector3d& query, int k, std::vector<Neighbor>* out) const {
  out->resize(std::min<std::size_t>(k, impl_->points.size()));
  const int found = KNearest(query, static_cast<int>(out->size()), out->data());
  out->resize(found);
  return found;
}

int KdTree::RadiusSearch(const Eigen::Vector3d& query,
                         double radius,
                         std::vector<Neighbor>* out) const {
  out->clear();
  if (!(radius >= 0.0) || !query.allFinite()) return 0;
  RadiusSet result(radius * radius, out);
  SearchAround(impl_->tree, impl_->leaves.data(), query, &result);
  std::sort(out->begin(), out->end(), [](const Neighbor& a, const Neighbor& b) {
    return Before(a.squared_distance, a.index, b);
  });
  return static_cast<int>(out->size());
}

}  // namespace ceres_ed
