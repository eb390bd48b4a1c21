#include "ceres_ed/geometry/closest_point.h"

#include <ceres_ed/geometry/kd_tree.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

constexpr int kLeafSize = 4;
// The median split halves the triangles, so 64 levels hold more than memory can.
constexpr int kMaxDepth = 64;
// A triangle this much flatter than wide is closest with its edges, and its plane is unknown.
constexpr double kFlatness = 1e-10;
// Boxes are compared with a little slack, so that rounding does not hide an equally near triangle.
constexpr double kBoundSlack = 1.0 - 1e-12;

struct TriangleItem {
  Eigen::Vector3d a, b, c;
  int index;
  // Bit i: the edge opposite to corner i is a border; bit 3 + i: corner i is on a border.
  std::uint8_t border;
};

// An inner node has its children at `first` and `first + 1`; a leaf has `count` triangles.
struct BoxNode {
  Eigen::AlignedBox3d box;
  int first = 0;
  int count = 0;
};

// The fraction of the way from a to b of the point closest to `query`, in [0, 1].
double ClosestFraction(const Eigen::Vector3d& query,
                       const Eigen::Vector3d& a,
                       const Eigen::Vector3d& b) {
  const double squared_length = (b - a).squaredNorm();
  if (!(squared_length > 0.0)) return 0.0;
  return std::clamp((query - a).dot(b - a) / squared_length, 0.0, 1.0);
}

Eigen::Vector3d ClosestOnEdges(const Eigen::Vector3d& query,
                               const std::array<const Eigen::Vector3d*, 3>& corners) {
  Eigen::Vector3d best = Eigen::Vector3d::UnitX();
  double best_distance = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double t = ClosestFraction(query, *corners[i], *corners[j]);
    const double distance = (query - (*corners[i] + t * (*corners[j] - *corners[i]))).squaredNorm();
    if (distance >= best_distance) continue;
    best_distance = distance;
    best.setZero();
    best[i] = 1.0 - t;
    best[j] = t;
  }
  return best;
}

Eigen::AlignedBox3d BoxOf(const TriangleItem& item) {
  Eigen::AlignedBox3d box(item.a);
  box.extend(item.b);
  box.extend(item.c);
  return box;
}

}  // namespace

// By the Voronoi regions of the triangle (Ericson, Real-Time Collision Detection, 5.1.5).
Eigen::Vector3d ClosestPointOnTriangle(const Eigen::Vector3d& query,
                                       const Eigen::Vector3d& a,
                                       const Eigen::Vector3d& b,
                                       const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a;
  const double widest = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  if (!(ab.cross(ac).squaredNorm() > kFlatness * kFlatness * widest * widest))
    return ClosestOnEdges(query, {&a, &b, &c});
  const Eigen::Vector3d aq = query - a;
  const double d1 = ab.dot(aq), d2 = ac.dot(aq);
  if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
  const Eigen::Vector3d bq = query - b;
  const double d3 = ab.dot(bq), d4 = ac.dot(bq);
  if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double t = d1 / (d1 - d3);
    return {1.0 - t, t, 0.0};
  }
  const Eigen::Vector3d cq = query - c;
  const double d5 = ab.dot(cq), d6 = ac.dot(cq);
  if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double t = d2 / (d2 - d6);
    return {1.0 - t, 0.0, t};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0.0, 1.0 - t, t};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

struct SurfaceIndex::Impl {
  explicit Impl(const PointCloud& cloud) : cloud(cloud) {}

  void CollectTriangles(const SurfaceTopology& topology) {
    items.reserve(cloud.triangles.size());
    for (std::size_t i = 0; i < cloud.triangles.size(); ++i) {
      const auto [a, b, c] = cloud.triangles[i];
      const int ra = topology.representative[a], rb = topology.representative[b],
                rc = topology.representative[c];
      if (ra == rb || rb == rc || rc == ra) continue;
      const int border = (topology.IsBorderEdge(b, c) ? 1 : 0) |
                         (topology.IsBorderEdge(c, a) ? 2 : 0) |
                         (topology.IsBorderEdge(a, b) ? 4 : 0) | (topology.is_border[a] ? 8 : 0) |
                         (topology.is_border[b] ? 16 : 0) | (topology.is_border[c] ? 32 : 0);
      items.push_back({cloud.points[a],
                       cloud.points[b],
                       cloud.points[c],
                       static_cast<int>(i),
                       static_cast<std::uint8_t>(border)});
    }
  }

  void Build(int node, int first, int last) {
    Eigen::AlignedBox3d box, centers;
    for (int i = first; i < last; ++i) {
      const Eigen::AlignedBox3d item_box = BoxOf(items[i]);
      box.extend(item_box);
      centers.extend(item_box.center());
    }
    nodes[node].box = box;
    if (last - first <= kLeafSize) {
      nodes[node].first = first;
      nodes[node].count = last - first;
      return;
    }
    Eigen::Index axis = 0;
    centers.sizes().maxCoeff(&axis);
    const int middle = first + (last - first) / 2;
    std::nth_element(items.begin() + first,
                     items.begin() + middle,
                     items.begin() + last,
                     [axis](const TriangleItem& s, const TriangleItem& t) {
                       const double cs = std::min({s.a[axis], s.b[axis], s.c[axis]}) +
                                         std::max({s.a[axis], s.b[axis], s.c[axis]});
                       const double ct = std::min({t.a[axis], t.b[axis], t.c[axis]}) +
                                         std::max({t.a[axis], t.b[axis], t.c[axis]});
                       return cs != ct ? cs < ct : s.index < t.index;
                     });
    const int children = static_cast<int>(nodes.size());
    nodes[node].first = children;
    nodes.resize(nodes.size() + 2);
    Build(children, first, middle);
    Build(children + 1, middle, last);
  }

  struct Best {
    double squared_distance;
    int item = -1;
    Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
  };

  void VisitLeaf(const BoxNode& leaf, const Eigen::Vector3d& query, Best* best) const {
    for (int i = leaf.first; i < leaf.first + leaf.count; ++i) {
      const TriangleItem& item = items[i];
      const Eigen::Vector3d barycentric = ClosestPointOnTriangle(query, item.a, item.b, item.c);
      const Eigen::Vector3d position =
          barycentric[0] * item.a + barycentric[1] * item.b + barycentric[2] * item.c;
      const double distance = (query - position).squaredNorm();
      if (distance > best->squared_distance) continue;
      if (best->item >= 0 && distance == best->squared_distance &&
          item.index > items[best->item].index) {
        continue;
      }
      *best = {distance, i, barycentric, position};
    }
  }

  Best Search(const Eigen::Vector3d& query, double squared_bound) const {
    struct Pending {
      double squared_distance;
      int node;
    };
    Best best{squared_bound};
    std::array<Pending, kMaxDepth> stack;
    int size = 0;
    stack[size++] = {nodes[0].box.squaredExteriorDistance(query), 0};
    while (size > 0) {
      const Pending top = stack[--size];
      if (top.squared_distance * kBoundSlack > best.squared_distance) continue;
      const BoxNode& node = nodes[top.node];
      if (node.count > 0) {
        VisitLeaf(node, query, &best);
        continue;
      }
      Pending near{nodes[node.first].box.squaredExteriorDistance(query), node.first};
      Pending far{nodes[node.first + 1].box.squaredExteriorDistance(query), node.first + 1};
      if (far.squared_distance < near.squared_distance) std::swap(near, far);
      stack[size++] = far;
      stack[size++] = near;
    }
    return best;
  }

  SurfaceHit HitOf(const Best& best) const {
    SurfaceHit hit;
    if (best.item < 0) return hit;
    const TriangleItem& item = items[best.item];
    hit.position = best.position;
    hit.squared_distance = best.squared_distance;
    hit.triangle = item.index;
    hit.barycentric = best.barycentric;
    const std::array<double, 3> to_corner = {(hit.position - item.a).squaredNorm(),
                                             (hit.position - item.b).squaredNorm(),
                                             (hit.position - item.c).squaredNorm()};
    const auto nearest = std::min_element(to_corner.begin(), to_corner.end()) - to_corner.begin();
    hit.nearest_vertex = cloud.triangles[item.index][nearest];
    for (int i = 0; i < 3; ++i) {
      const bool on_edge = best.barycentric[i] == 0.0;
      const bool at_corner = best.barycentric[i] == 1.0;
      if (on_edge && (item.border >> i & 1) != 0) hit.on_border = true;
      if (at_corner && (item.border >> (3 + i) & 1) != 0) hit.on_border = true;
    }
    return hit;
  }

  const PointCloud& cloud;
  std::vector<TriangleItem> items;
  std::vector<BoxNode> nodes;
  // Only where there is no triangle.
  std::optional<KdTree> point_tree;
};

SurfaceIndex::SurfaceIndex(const PointCloud& cloud, const SurfaceTopology& topology)
    : impl_(std::make_unique<Impl>(cloud)) {
  impl_->CollectTriangles(topology);
  if (impl_->items.empty()) {
    impl_->point_tree.emplace(cloud.points);
    return;
  }
  impl_->nodes.reserve(impl_->items.size());
  impl_->nodes.resize(1);
  impl_->Build(0, 0, static_cast<int>(impl_->items.size()));
}

SurfaceIndex::SurfaceIndex(const PointCloud& cloud) : SurfaceIndex(cloud, BuildTopology(cloud)) {}
SurfaceIndex::~SurfaceIndex() = default;
SurfaceIndex::SurfaceIndex(SurfaceIndex&&) noexcept = default;
SurfaceIndex& SurfaceIndex::operator=(SurfaceIndex&&) noexcept = default;

SurfaceHit SurfaceIndex::Closest(const Eigen::Vector3d& query, double max_distance) const {
  if (!(max_distance >= 0.0) || !query.allFinite()) return {};
  if (!impl_->point_tree) return impl_->HitOf(impl_->Search(query, max_distance * max_distance));
  const Neighbor nearest = impl_->point_tree->NearestWithin(query, max_distance);
  SurfaceHit hit;
  if (!nearest.found()) return hit;
  hit.position = impl_->cloud.points[nearest.index];
  hit.squared_distance = nearest.squared_distance;
  hit.nearest_vertex = nearest.index;
  return hit;
}

}  // namespace ceres_ed
