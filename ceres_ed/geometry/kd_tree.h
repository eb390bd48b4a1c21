// Exact search for nearest neighbours among points in space.
#ifndef CERES_ED_GEOMETRY_KD_TREE_H_
#define CERES_ED_GEOMETRY_KD_TREE_H_

#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A point found by a search. If there is none, the index is -1 and the distance is infinite.
struct Neighbor {
  int index = -1;
  double squared_distance = std::numeric_limits<double>::infinity();

  bool found() const { return index >= 0; }
};

// A search tree over `points`, which must be finite. The tree refers to the points: they must
// outlive it and must not change except before an Update(). Every search is exact, breaks ties by
// the lowest index, and finds nothing for a query that is not finite. Any number of threads may
// search at the same time.
class KdTree {
 public:
  explicit KdTree(const std::vector<Eigen::Vector3d>& points);
  ~KdTree();
  KdTree(KdTree&&) noexcept;
  KdTree& operator=(KdTree&&) noexcept;

  // Rebuilds the tree after points have moved. The vector of points must be the same, and have the
  // same size. No search may run at the same time.
  void Update();

  // Returns the indices of the points in the order of the tree. Points that are near in this order
  // are near in space, so searches in this order use the cache well.
  const std::vector<int>& order() const;

  // Returns the point nearest to `query`; none when the tree is empty.
  Neighbor Nearest(const Eigen::Vector3d& query) const;

  // Returns the nearest point that is at most `max_distance` away; none when there is no such
  // point. `hint` is a point that is expected to be near, or -1. A near hint makes the search
  // faster; the result does not depend on it.
  Neighbor NearestWithin(const Eigen::Vector3d& query, double max_distance, int hint = -1) const;

  // Writes the nearest min(k, number of points) neighbours to out[0], out[1], ..., sorted by
  // distance, then by index. Returns how many there are. `out` must have room for k.
  int KNearest(const Eigen::Vector3d& query, int k, Neighbor* out) const;
  // Does the same; `out` is resized to the number found.
  int KNearest(const Eigen::Vector3d& query, int k, std::vector<Neighbor>* out) const;

  // Writes all points that are at most `radius` away, sorted by distance, then by index. Returns
  // how many there are.
  int RadiusSearch(const Eigen::Vector3d& query, double radius, std::vector<Neighbor>* out) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_KD_TREE_H_
