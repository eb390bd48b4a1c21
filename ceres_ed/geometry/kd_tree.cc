#include "ceres_ed/geometry/kd_tree.h"

#include <algorithm>
#include <cstddef>

#include <glog/logging.h>
#include <nanoflann.hpp>

namespace ceres_ed {
namespace {

// Distances to subtrees have rounding errors. This tolerance keeps points that are equally far
// among the candidates.
constexpr double kBoundSlack = 1.0 + 1e-12;

#if NANOFLANN_VERSION >= 0x150
using SearchOptions = nanoflann::SearchParameters;
#else
using SearchOptions = nanoflann::SearchParams;
#endif

// The interface through which nanoflann reads the points.
struct PointAdaptor {
  const std::vector<Eigen::Vector3d>& points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t index, std::size_t axis) const { return points[index][axis]; }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

// Returns the bound with which nanoflann compares distances. nanoflann tests for "less than", so
// the bound is above zero: points equal to the query are then all found.
double SearchBound(double squared_distance) {
  return std::max(squared_distance * kBoundSlack, std::numeric_limits<double>::min());
}

bool Before(double distance_a, int index_a, const Neighbor& b) {
  return distance_a < b.squared_distance || (distance_a == b.squared_distance && index_a < b.index);
}

// Of two equally far points, the result sets of nanoflann keep the one that they meet first. The
// following three prefer the lowest index, so that the result does not depend on the shape of the
// tree.
class NearestSet {
 public:
  using DistanceType = double;

  explicit NearestSet(double squared_bound) : bound_(squared_bound) {}
  double worstDist() const { return SearchBound(bound_); }
  bool full() const { return best_.found(); }
  std::size_t size() const { return best_.found() ? 1 : 0; }
  void sort() {}
  bool addPoint(double squared_distance, int index) {
    if (!(squared_distance <= bound_)) return true;
    if (!best_.found() || Before(squared_distance, index, best_)) {
      best_ = {index, squared_distance};
      bound_ = squared_distance;
    }
    return true;
  }
  const Neighbor& best() const { return best_; }

 private:
  double bound_;
  Neighbor best_;
};

class KNearestSet {
 public:
  using DistanceType = double;

  KNearestSet(Neighbor* out, int capacity) : out_(out), capacity_(capacity) {}
  double worstDist() const {
    return count_ < capacity_ ? std::numeric_limits<double>::infinity()
                              : SearchBound(out_[capacity_ - 1].squared_distance);
  }
  bool full() const { return count_ == capacity_; }
  std::size_t size() const { return count_; }
  void sort() {}
  bool addPoint(double squared_distance, int index) {
    if (count_ == capacity_ && !Before(squared_distance, index, out_[count_ - 1])) return true;
    int i = count_ < capacity_ ? count_++ : capacity_ - 1;
    for (; i > 0 && Before(squared_distance, index, out_[i - 1]); --i) out_[i] = out_[i - 1];
    out_[i] = {index, squared_distance};
    return true;
  }

 private:
  Neighbor* out_;
  int capacity_;
  int count_ = 0;
};

class RadiusSet {
 public:
  using DistanceType = double;

  RadiusSet(double squared_radius, std::vector<Neighbor>* out)
      : squared_radius_(squared_radius), out_(out) {}
  double worstDist() const { return SearchBound(squared_radius_); }
  bool full() const { return true; }
  std::size_t size() const { return out_->size(); }
  void sort() {}
  bool addPoint(double squared_distance, int index) {
    if (squared_distance <= squared_radius_) out_->push_back({index, squared_distance});
    return true;
  }

 private:
  double squared_radius_;
  std::vector<Neighbor>* out_;
};

}  // namespace

struct KdTree::Impl {
  using Tree =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointAdaptor>,
                                          PointAdaptor,
                                          3,
                                          int>;

  explicit Impl(const std::vector<Eigen::Vector3d>& points)
      : adaptor{points}, tree(3, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(8)) {}

  template <typename ResultSet>
  void Search(const Eigen::Vector3d& query, ResultSet* result) const {
    if (adaptor.points.empty() || !query.allFinite()) return;
    tree.findNeighbors(*result, query.data(), SearchOptions());
  }

  PointAdaptor adaptor;
  Tree tree;
};

KdTree::KdTree(const std::vector<Eigen::Vector3d>& points)
    : impl_(std::make_unique<Impl>(points)) {}
KdTree::~KdTree() = default;
KdTree::KdTree(KdTree&&) noexcept = default;
KdTree& KdTree::operator=(KdTree&&) noexcept = default;

Neighbor KdTree::Nearest(const Eigen::Vector3d& query) const {
  return NearestWithin(query, std::numeric_limits<double>::infinity());
}

void KdTree::Update() { impl_->tree.buildIndex(); }

const std::vector<int>& KdTree::order() const {
#if NANOFLANN_VERSION >= 0x150
  return impl_->tree.vAcc_;
#else
  return impl_->tree.vAcc;
#endif
}

Neighbor KdTree::NearestWithin(const Eigen::Vector3d& query, double max_distance, int hint) const {
  if (!(max_distance >= 0.0)) return {};
  double bound = max_distance * max_distance;
  if (hint >= 0) {
    const double squared_distance = (impl_->adaptor.points[hint] - query).squaredNorm();
    // The tolerance is needed because nanoflann adds the terms of a distance in another order.
    if (squared_distance * kBoundSlack < bound) bound = squared_distance * kBoundSlack;
  }
  NearestSet result(bound);
  impl_->Search(query, &result);
  return result.best();
}

int KdTree::KNearest(const Eigen::Vector3d& query, int k, Neighbor* out) const {
  CHECK_GE(k, 0);
  if (k == 0) return 0;
  KNearestSet result(out, k);
  impl_->Search(query, &result);
  return static_cast<int>(result.size());
}

int KdTree::KNearest(const Eigen::Vector3d& query, int k, std::vector<Neighbor>* out) const {
  out->resize(std::min<std::size_t>(k, impl_->adaptor.points.size()));
  const int found = KNearest(query, static_cast<int>(out->size()), out->data());
  out->resize(found);
  return found;
}

int KdTree::RadiusSearch(const Eigen::Vector3d& query,
                         double radius,
                         std::vector<Neighbor>* out) const {
  out->clear();
  if (!(radius >= 0.0)) return 0;
  RadiusSet result(radius * radius, out);
  impl_->Search(query, &result);
  std::sort(out->begin(), out->end(), [](const Neighbor& a, const Neighbor& b) {
    return Before(a.squared_distance, a.index, b);
  });
  return static_cast<int>(out->size());
}

}  // namespace ceres_ed
