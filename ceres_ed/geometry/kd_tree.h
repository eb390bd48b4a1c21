// Exact nearest neighbours among points in space.
#ifndef CERES_ED_GEOMETRY_KD_TREE_H_
#define CERES_ED_GEOMETRY_KD_TREE_H_

#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A point found by a search; index -1 (and an infinite distance) when there is none.
struct Neighbor {
  int index = -1;
  double squared_distance = std::numeric_limits<double>::infinity();

  bool found() const { return index >= 0; }
};

// A search tree over finite `points`, kept by reference: they must outlive the tree and stay as
// they are between updates. Every search is exact, breaks ties by the lowest index, finds nothing
// for a query that is not finite, and may run on any number of threads at once.
class KdTree {
 public:
  explicit KdTree(const std::vector<Eigen::Vector3d>& points);
  ~KdTree();
  KdTree(KdTree&&) noexcept;
  KdTree& operator=(KdTree&&) noexcept;

  // Call it after points have moved: from then on searches find them where they are. Their number
  // and the vector are the same. No search may run meanwhile.
  void Update();

  // The points as they lie in the tree: near in it is near in space. Searches in this order find
  // in the cache what the one before has read.
  const std::vector<int>& order() const;

  // The point nearest to `query`; none when the tree is empty.
  Neighbor Nearest(const Eigen::Vector3d& query) const;

  // The nearest point that is at most `max_distance` away; none when there is no such point. `hint`
  // is a point that is thought to be near, or -1: the nearer it is the faster is the search, and
  // what is found doesn't depend on it.
  Neighbor NearestWithin(const Eigen::Vector3d& query, double max_distance, int hint = -1) const;

  // Writes the nearest min(k, number of points) neighbours to out[0..] by distance, then by index,
  // and returns how many. `out` has room for k.
  int KNearest(const Eigen::Vector3d& query, int k, Neighbor* out) const;
  // The same; `out` is resized to the number found.
  int KNearest(const Eigen::Vector3d& query, int k, std::vector<Neighbor>* out) const;

  // Writes every point at most `radius` away, by distance, then by index; returns how many.
  int RadiusSearch(const Eigen::Vector3d& query, double radius, std::vector<Neighbor>* out) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_KD_TREE_H_
