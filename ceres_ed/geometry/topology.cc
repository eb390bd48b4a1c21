#include "ceres_ed/geometry/topology.h"

#include <ceres_ed/geometry/bounding_box.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// Points are the same if their coordinates are equal when rounded to about this part of the
// diagonal. Programs that compute a seam twice (sin 0 and sin 2 pi) leave less between its sides,
// and moving a cloud leaves less, too.
constexpr double kWeldDistance = 1e-12;

// One triangle at a point: the edge to `neighbor`, and the corner opposite to that edge. Both are
// stored in one number, so that wings compare by neighbour, then by corner.
class Wing {
 public:
  Wing() = default;
  Wing(int neighbor, int opposite)
      : key_(static_cast<std::uint64_t>(neighbor) << 32 | static_cast<std::uint32_t>(opposite)) {}

  int neighbor() const { return static_cast<int>(key_ >> 32); }
  int opposite() const { return static_cast<int>(key_ & 0xffffffffu); }
  bool operator<(const Wing& other) const { return key_ < other.key_; }
  bool operator==(const Wing& other) const { return key_ == other.key_; }

 private:
  std::uint64_t key_ = 0;
};

// The wings of point p are wings[offsets[p]] to wings[offsets[p + 1]].
struct Wings {
  std::vector<int> offsets;
  std::vector<Wing> wings;
};

// A straight line between two corners across the edge that their triangles share.
struct Shortcut {
  int from;
  int to;
  double length;
};

template <typename T>
std::vector<int> OffsetsFromCounts(const std::vector<T>& counts) {
  std::vector<int> offsets(counts.size() + 1, 0);
  for (std::size_t i = 0; i < counts.size(); ++i) offsets[i + 1] = offsets[i] + counts[i];
  return offsets;
}

// Returns the representatives of the corners; none if welding has made two of them equal.
std::optional<std::array<int, 3>> WeldedCorners(const std::array<int, 3>& triangle,
                                                const std::vector<int>& representative) {
  const std::array<int, 3> corners = {
      representative[triangle[0]], representative[triangle[1]], representative[triangle[2]]};
  if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return {};
  return corners;
}

Wings CollectWings(const PointCloud& cloud, const std::vector<int>& representative) {
  const int num_points = static_cast<int>(cloud.size());
  std::vector<int> counts(num_points, 0);
  for (const std::array<int, 3>& triangle : cloud.triangles) {
    for (const int corner : triangle) {
      CHECK(corner >= 0 && corner < num_points)
          << "triangle corner " << corner << " of " << num_points << " points";
    }
    if (const auto corners = WeldedCorners(triangle, representative)) {
      for (const int corner : *corners) counts[corner] += 2;
    }
  }
  Wings result;
  result.offsets = OffsetsFromCounts(counts);
  result.wings.resize(result.offsets.back());
  std::vector<int> next(result.offsets.begin(), result.offsets.end() - 1);
  for (const std::array<int, 3>& triangle : cloud.triangles) {
    const auto corners = WeldedCorners(triangle, representative);
    if (!corners) continue;
    for (int i = 0; i < 3; ++i) {
      const int a = (*corners)[i], b = (*corners)[(i + 1) % 3], c = (*corners)[(i + 2) % 3];
      result.wings[next[a]++] = {b, c};
      result.wings[next[a]++] = {c, b};
    }
  }
  for (int p = 0; p < num_points; ++p) {
    std::sort(result.wings.begin() + result.offsets[p],
              result.wings.begin() + result.offsets[p + 1]);
  }
  return result;
}

// Returns the length of the straight line from c to d when the triangles abc and bad are unfolded
// into a plane; none if the line does not cross the edge ab.
std::optional<double> UnfoldedLength(const Eigen::Vector3d& a,
                                     const Eigen::Vector3d& b,
                                     const Eigen::Vector3d& c,
                                     const Eigen::Vector3d& d) {
  const Eigen::Vector3d ab = b - a;
  const double length = ab.norm();
  if (!(length > 0.0)) return {};
  const Eigen::Vector3d axis = ab / length;
  const double xc = (c - a).dot(axis);
  const double xd = (d - a).dot(axis);
  const double yc = (c - a - xc * axis).norm();
  const double yd = (d - a - xd * axis).norm();
  if (!(yc + yd > 0.0)) return {};
  const double crossing = xc + (xd - xc) * yc / (yc + yd);
  if (crossing <= 0.0 || crossing >= length) return {};
  return std::hypot(xc - xd, yc + yd);
}

// Computes the edges and borders of the representatives, and returns the shortcuts.
std::vector<Shortcut> ExtractEdges(const PointCloud& cloud,
                                   const Wings& wings,
                                   SurfaceTopology* topology) {
  const int num_points = static_cast<int>(cloud.size());
  std::vector<int> rank(num_points, 0);
  for (std::size_t i = 0; i < topology->walk_order.size(); ++i) rank[topology->walk_order[i]] = i;
  std::vector<Shortcut> shortcuts;
  topology->edge_offsets.assign(1, 0);
  topology->edge_offsets.reserve(num_points + 1);
  topology->edges.reserve(wings.wings.size() / 2 + num_points);
  topology->edge_is_border.reserve(topology->edges.capacity());
  shortcuts.reserve(wings.wings.size() / 4);
  for (int p = 0; p < num_points; ++p) {
    const auto end = wings.wings.begin() + wings.offsets[p + 1];
    for (auto it = wings.wings.begin() + wings.offsets[p]; it != end;) {
      const int q = it->neighbor();
      // Find the first two different opposite corners. A triangle that is listed twice counts once.
      int opposite[2] = {it->opposite(), -1};
      int num_opposite = 1;
      for (++it; it != end && it->neighbor() == q; ++it) {
        if (*it == *(it - 1)) continue;
        if (num_opposite++ == 1) opposite[1] = it->opposite();
      }
      topology->edges.push_back({q, (cloud.points[p] - cloud.points[q]).norm()});
      topology->edge_is_border.push_back(num_opposite == 1);
      topology->is_border[p] |= static_cast<char>(num_opposite == 1);
      if (num_opposite != 2 || rank[p] > rank[q]) continue;
      // The corners are sorted by rank, so that the length has the same bits for any order of the
      // points.
      if (rank[opposite[0]] > rank[opposite[1]]) std::swap(opposite[0], opposite[1]);
      const auto length = UnfoldedLength(
          cloud.points[p], cloud.points[q], cloud.points[opposite[0]], cloud.points[opposite[1]]);
      if (length) shortcuts.push_back({opposite[0], opposite[1], *length});
    }
    topology->edge_offsets.push_back(static_cast<int>(topology->edges.size()));
  }
  return shortcuts;
}

// Joins the mesh edges and the shortcuts into `paths`.
void BuildPaths(const std::vector<Shortcut>& shortcuts, SurfaceTopology* topology) {
  const int num_points = topology->num_points();
  std::vector<int> counts(num_points);
  for (int p = 0; p < num_points; ++p) counts[p] = topology->Edges(p).size();
  for (const Shortcut& shortcut : shortcuts) {
    ++counts[shortcut.from];
    ++counts[shortcut.to];
  }
  topology->path_offsets = OffsetsFromCounts(counts);
  topology->paths.resize(topology->path_offsets.back());
  std::vector<int> next(topology->path_offsets.begin(), topology->path_offsets.end() - 1);
  for (int p = 0; p < num_points; ++p) {
    for (const SurfaceLink& edge : topology->Edges(p)) topology->paths[next[p]++] = edge;
  }
  for (const Shortcut& shortcut : shortcuts) {
    topology->paths[next[shortcut.from]++] = {shortcut.to, shortcut.length};
    topology->paths[next[shortcut.to]++] = {shortcut.from, shortcut.length};
  }
}

// Numbers the connected components by a flood fill along the edges.
void LabelComponents(SurfaceTopology* topology) {
  const int num_points = topology->num_points();
  topology->component.assign(num_points, -1);
  std::vector<int> stack;
  for (int start = 0; start < num_points; ++start) {
    if (topology->representative[start] != start || topology->component[start] >= 0) continue;
    const int label = topology->num_components();
    topology->component[start] = label;
    int size = 0;
    stack.assign(1, start);
    while (!stack.empty()) {
      const int p = stack.back();
      stack.pop_back();
      ++size;
      for (const SurfaceLink& edge : topology->Edges(p)) {
        if (topology->component[edge.to] >= 0) continue;
        topology->component[edge.to] = label;
        stack.push_back(edge.to);
      }
    }
    topology->component_sizes.push_back(size);
  }
}

}  // namespace

bool SurfaceTopology::IsBorderEdge(int point, int other) const {
  const int from = representative[point];
  const int to = representative[other];
  const SurfaceLinks links = Edges(from);
  const SurfaceLink* link = std::lower_bound(
      links.begin(), links.end(), to, [](const SurfaceLink& a, int value) { return a.to < value; });
  return link != links.end() && link->to == to && edge_is_border[link - edges.data()] != 0;
}

SurfaceTopology BuildTopology(const PointCloud& cloud) {
  const int num_points = static_cast<int>(cloud.size());
  SurfaceTopology topology;
  topology.representative = WeldPoints(cloud.points, &topology.walk_order);
  topology.is_border.assign(num_points, 0);
  const Wings wings = CollectWings(cloud, topology.representative);
  BuildPaths(ExtractEdges(cloud, wings, &topology), &topology);
  LabelComponents(&topology);
  topology.is_isolated.resize(num_points);
  for (int p = 0; p < num_points; ++p) {
    const int representative = topology.representative[p];
    topology.is_isolated[p] = static_cast<char>(topology.Edges(representative).size() == 0);
    topology.is_border[p] = topology.is_border[representative];
    topology.component[p] = topology.component[representative];
  }
  return topology;
}

std::vector<int> WeldPoints(const std::vector<Eigen::Vector3d>& points,
                            std::vector<int>* walk_order) {
  struct Item {
    double x, y, z;
    int index;
  };
  // A power of two, so that scaling by it is exact.
  const double diagonal = Diagonal(points);
  const double cells = std::exp2(std::floor(-std::log2(kWeldDistance * diagonal)));
  const bool has_cells = std::isfinite(cells) && cells > 0.0;
  const auto snap = [cells, has_cells](double x) {
    // Adding zero turns -0 into 0.
    return (has_cells ? std::nearbyint(x * cells) : x) + 0.0;
  };
  std::vector<Item> items(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    items[i] = {snap(points[i].x()), snap(points[i].y()), snap(points[i].z()), static_cast<int>(i)};
  }
  std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    if (a.z != b.z) return a.z < b.z;
    return a.index < b.index;
  });
  std::vector<int> representative(points.size());
  if (walk_order != nullptr) walk_order->clear();
  for (std::size_t i = 0; i < items.size(); ++i) {
    const bool same = i > 0 && items[i].x == items[i - 1].x && items[i].y == items[i - 1].y &&
                      items[i].z == items[i - 1].z;
    representative[items[i].index] = same ? representative[items[i - 1].index] : items[i].index;
    if (!same && walk_order != nullptr) walk_order->push_back(items[i].index);
  }
  return representative;
}

double MeanEdgeLength(const SurfaceTopology& topology) {
  if (topology.edges.empty()) return 0.0;
  const double sum = std::accumulate(
      topology.edges.begin(), topology.edges.end(), 0.0, [](double total, const SurfaceLink& edge) {
        return total + edge.length;
      });
  return sum / static_cast<double>(topology.edges.size());
}

}  // namespace ceres_ed
