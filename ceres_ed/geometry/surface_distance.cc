#include "ceres_ed/geometry/surface_distance.h"

#include <algorithm>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct QueueEntry {
  double distance;
  int seed;
  int point;
};

// Puts the nearest entry on top of the heap. Ties are broken by the seed, in the same way as among
// the labels of a point.
struct Farther {
  bool operator()(const QueueEntry& a, const QueueEntry& b) const {
    if (a.distance != b.distance) return a.distance > b.distance;
    return a.seed > b.seed;
  }
};

// Dijkstra's algorithm with up to k labels (seed, distance) for each point. The labels are kept
// sorted in the arrays of the result. Since the labels of a point leave the queue in that order,
// the settled ones come first.
class MultiSeedSearch {
 public:
  MultiSeedSearch(const SurfaceTopology& topology, int k) : topology_(topology), k_(k) {
    const std::size_t num_points = topology.representative.size();
    result_.k = k;
    result_.seeds.assign(num_points * k, -1);
    result_.distances.assign(num_points * k, kInfinity);
    num_settled_.assign(num_points, 0);
    queue_.reserve(num_points);
  }

  // Enters a path from `seed` to `point` if it is among the k shortest to that point.
  void Relax(int point, int seed, double distance) {
    int* seeds = &result_.seeds[static_cast<std::size_t>(point) * k_];
    double* distances = &result_.distances[static_cast<std::size_t>(point) * k_];
    const auto before = [&](int i) {
      return distance < distances[i] || (distance == distances[i] && seed < seeds[i]);
    };
    if (distances[k_ - 1] <= distance && !before(k_ - 1)) return;
    // The new label replaces an older one of the same seed, otherwise the last one.
    int place = 0;
    while (place < k_ - 1 && seeds[place] != seed) ++place;
    if (seeds[place] == seed && distances[place] <= distance) return;
    for (; place > 0 && before(place - 1); --place) {
      seeds[place] = seeds[place - 1];
      distances[place] = distances[place - 1];
    }
    seeds[place] = seed;
    distances[place] = distance;
    queue_.push_back({distance, seed, point});
    std::push_heap(queue_.begin(), queue_.end(), Farther());
  }

  void Run(const std::function<bool()>& should_stop) {
    constexpr int kStepsPerCheck = 1 << 14;
    int steps = 0;
    while (!queue_.empty()) {
      if (++steps % kStepsPerCheck == 0 && should_stop && should_stop()) return;
      std::pop_heap(queue_.begin(), queue_.end(), Farther());
      const QueueEntry entry = queue_.back();
      queue_.pop_back();
      int& settled = num_settled_[entry.point];
      const std::size_t label = static_cast<std::size_t>(entry.point) * k_ + settled;
      if (settled == k_ || result_.seeds[label] != entry.seed ||
          result_.distances[label] != entry.distance) {
        continue;
      }
      ++settled;
      for (const SurfaceLink& link : topology_.Paths(entry.point)) {
        Relax(link.to, entry.seed, entry.distance + link.length);
      }
    }
  }

  // Copies the labels of each representative to the points that are welded to it.
  NearestSeeds TakeResult() {
    for (int p = 0; p < topology_.num_points(); ++p) {
      const std::size_t from = static_cast<std::size_t>(topology_.representative[p]) * k_;
      const std::size_t to = static_cast<std::size_t>(p) * k_;
      if (from == to) continue;
      std::copy_n(result_.seeds.begin() + from, k_, result_.seeds.begin() + to);
      std::copy_n(result_.distances.begin() + from, k_, result_.distances.begin() + to);
    }
    return std::move(result_);
  }

 private:
  const SurfaceTopology& topology_;
  const int k_;
  NearestSeeds result_;
  std::vector<int> num_settled_;
  std::vector<QueueEntry> queue_;
};

}  // namespace

int NearestSeeds::Count(int point) const {
  const int* first = SeedsOf(point);
  return static_cast<int>(std::find(first, first + k, -1) - first);
}

NearestSeeds NearestSeedsAlongSurface(const SurfaceTopology& topology,
                                      const std::vector<int>& seed_points,
                                      int k,
                                      const std::vector<double>& offsets,
                                      const std::function<bool()>& should_stop) {
  CHECK_GE(k, 1);
  CHECK(offsets.empty() || offsets.size() == seed_points.size())
      << offsets.size() << " offsets of " << seed_points.size() << " seeds";
  MultiSeedSearch search(topology, k);
  for (std::size_t seed = 0; seed < seed_points.size(); ++seed) {
    const int point = seed_points[seed];
    CHECK(point >= 0 && point < topology.num_points()) << "seed at point " << point;
    const double offset = offsets.empty() ? 0.0 : offsets[seed];
    CHECK_GE(offset, 0.0) << "offset of seed " << seed;
    search.Relax(topology.representative[point], static_cast<int>(seed), offset);
  }
  search.Run(should_stop);
  return search.TakeResult();
}

}  // namespace ceres_ed
