#include "ceres_ed/geometry/sampling.h"

#include <ceres_ed/geometry/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <unordered_map>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Points that are nearer than this fraction of the spacing count as within the spacing.
constexpr double kWithin = 1.0 - 1e-9;

// Samples sorted into cells of the size of the spacing. Two cells may have the same key; this costs
// comparisons but causes no error.
class SampleGrid {
 public:
  SampleGrid(const std::vector<Eigen::Vector3d>& points, double spacing)
      : points_(points), origin_(BoundingBox(points).min()), spacing_(spacing) {}

  bool HasSampleWithin(int point) const {
    const double squared_limit = std::pow(spacing_ * kWithin, 2);
    const auto [x, y, z] = CellOf(point);
    for (std::int64_t i = x - 1; i <= x + 1; ++i) {
      for (std::int64_t j = y - 1; j <= y + 1; ++j) {
        for (std::int64_t k = z - 1; k <= z + 1; ++k) {
          const auto cell = newest_.find(Key(i, j, k));
          if (cell == newest_.end()) continue;
          for (int s = cell->second; s >= 0; s = previous_[s]) {
            if ((points_[samples_[s]] - points_[point]).squaredNorm() < squared_limit) return true;
          }
        }
      }
    }
    return false;
  }

  void Add(int point) {
    const auto [x, y, z] = CellOf(point);
    const auto [cell, is_new] = newest_.try_emplace(Key(x, y, z), -1);
    previous_.push_back(cell->second);
    cell->second = static_cast<int>(samples_.size());
    samples_.push_back(point);
  }

  std::vector<int> TakeSamples() { return std::move(samples_); }

 private:
  struct Cell {
    std::int64_t x, y, z;
  };

  Cell CellOf(int point) const {
    // Cells are slightly wider than the spacing, so that rounding never puts a pair within the
    // spacing two cells apart.
    const Eigen::Vector3d cell =
        ((points_[point] - origin_) / (spacing_ * (1.0 + 1e-9))).array().floor().min(1e15);
    return {static_cast<std::int64_t>(cell.x()),
            static_cast<std::int64_t>(cell.y()),
            static_cast<std::int64_t>(cell.z())};
  }

  static std::uint64_t Key(std::int64_t x, std::int64_t y, std::int64_t z) {
    return static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15u ^
           static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4Fu ^
           static_cast<std::uint64_t>(z) * 0x165667B19E3779F9u;
  }

  const std::vector<Eigen::Vector3d>& points_;
  const Eigen::Vector3d origin_;
  const double spacing_;
  std::vector<int> samples_;
  // newest_ has the newest sample of a cell, and previous_ has, for each sample, the one before it
  // in the same cell. -1 ends the chain.
  std::unordered_map<std::uint64_t, int> newest_;
  std::vector<int> previous_;
};

// For each representative, the distance along the surface to the nearest sample so far.
class SampleDistances {
 public:
  explicit SampleDistances(const SurfaceTopology& topology)
      : topology_(topology), distances_(topology.num_points(), kInfinity) {}

  double operator[](int point) const { return distances_[point]; }

  // Adds `point` as a sample. Updates all points within `limit` that are nearer to it than to the
  // other samples.
  void Add(int point, double limit) {
    Offer(point, 0.0);
    while (!queue_.empty()) {
      std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
      const auto [distance, p] = queue_.back();
      queue_.pop_back();
      if (distance > distances_[p]) continue;
      for (const SurfaceLink& link : topology_.Paths(p)) {
        if (distance + link.length < limit) Offer(link.to, distance + link.length);
      }
    }
  }

 private:
  void Offer(int point, double distance) {
    if (distance >= distances_[point]) return;
    distances_[point] = distance;
    queue_.emplace_back(distance, point);
    std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
  }

  const SurfaceTopology& topology_;
  std::vector<double> distances_;
  std::vector<std::pair<double, int>> queue_;
};

// Returns whether the component of `point` is large enough to get samples.
bool IsEligible(const SurfaceTopology& topology, int point, int min_component_points) {
  return topology.component_sizes[topology.component[point]] >= min_component_points;
}

void CheckOptions(const FarthestPointOptions& options) {
  CHECK_GE(options.max_count, 1);
  CHECK_GE(options.min_spacing, 0.0);
}

}  // namespace

std::vector<int> UniformDownsample(const std::vector<Eigen::Vector3d>& points, double spacing) {
  CHECK_GT(spacing, 0.0);
  std::vector<int> walk_order;
  WeldPoints(points, &walk_order);
  SampleGrid grid(points, spacing);
  for (const int point : walk_order) {
    if (!grid.HasSampleWithin(point)) grid.Add(point);
  }
  return grid.TakeSamples();
}

std::vector<int> UniformDownsampleAlongSurface(const SurfaceTopology& topology,
                                               double spacing,
                                               int min_component_points) {
  CHECK_GT(spacing, 0.0);
  std::vector<int> samples;
  SampleDistances distances(topology);
  for (const int point : topology.walk_order) {
    if (distances[point] < spacing * kWithin) continue;
    if (!IsEligible(topology, point, min_component_points)) continue;
    samples.push_back(point);
    distances.Add(point, spacing * kWithin);
  }
  return samples;
}

std::vector<int> FarthestPointSample(const std::vector<Eigen::Vector3d>& points,
                                     const FarthestPointOptions& options) {
  CheckOptions(options);
  std::vector<int> walk_order;
  WeldPoints(points, &walk_order);
  std::vector<double> squared(walk_order.size(), kInfinity);
  std::vector<int> samples;
  const double squared_spacing = std::pow(options.min_spacing * kWithin, 2);
  // Squared distances have the same order as distances. Of several farthest points the first in
  // walk order is chosen.
  std::size_t farthest = 0;
  while (!walk_order.empty() && static_cast<int>(samples.size()) < options.max_count &&
         squared[farthest] > 0.0 && squared[farthest] >= squared_spacing) {
    samples.push_back(walk_order[farthest]);
    const Eigen::Vector3d& sample = points[samples.back()];
    farthest = 0;
    for (std::size_t i = 0; i < walk_order.size(); ++i) {
      squared[i] = std::min(squared[i], (points[walk_order[i]] - sample).squaredNorm());
      if (squared[i] > squared[farthest]) farthest = i;
    }
  }
  return samples;
}

std::vector<int> FarthestPointSampleAlongSurface(const SurfaceTopology& topology,
                                                 const FarthestPointOptions& options,
                                                 int min_component_points) {
  CheckOptions(options);
  // Distances can only shrink. An entry of the queue that is out of date is therefore too high; it
  // is put back with its new distance.
  struct Entry {
    double distance;
    int rank;
    bool operator<(const Entry& other) const {
      return distance != other.distance ? distance < other.distance : rank > other.rank;
    }
  };
  std::vector<Entry> entries;
  for (std::size_t rank = 0; rank < topology.walk_order.size(); ++rank) {
    if (!IsEligible(topology, topology.walk_order[rank], min_component_points)) continue;
    entries.push_back({kInfinity, static_cast<int>(rank)});
  }
  std::priority_queue<Entry> queue(std::less<Entry>(), std::move(entries));
  SampleDistances distances(topology);
  std::vector<int> samples;
  while (!queue.empty() && static_cast<int>(samples.size()) < options.max_count) {
    const Entry entry = queue.top();
    queue.pop();
    const int point = topology.walk_order[entry.rank];
    const double distance = distances[point];
    if (distance < entry.distance) {
      if (distance > 0.0) queue.push({distance, entry.rank});
      continue;
    }
    if (distance < options.min_spacing * kWithin) break;
    samples.push_back(point);
    distances.Add(point, kInfinity);
  }
  return samples;
}

}  // namespace ceres_ed
