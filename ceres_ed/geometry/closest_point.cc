#include "ceres_ed/geometry/closest_point.h"

#include <ceres_ed/geometry/box_tree.h>
#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/util/for_each_machine.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

constexpr int kLeafSize = kLanes;
// For triangles flatter than this ratio of height to width, the bounds below are not used, since
// their normals are not accurate enough.
constexpr double kBoundFlatness = 1e-4;
// Bounds of squared distances are compared with some tolerance for rounding errors: a fraction of
// the bound itself, and a fraction of the squared size of the largest triangle.
constexpr double kBoundSlack = 1.0 - 1e-6;
constexpr double kBoundRoom = 1e-18;
// The relative accuracy, with respect to the triangle's corners and the query, to which it is known
// on which side of an edge the query lies.
constexpr double kSideRoom = 1e-13;

// The triangles of a leaf, one in each lane: corner a, and the vectors from a to b and c. Lanes
// without a triangle hold values that are not a number.
struct TriangleLeaf {
  Lanes a[3];
  Lanes ab[3];
  Lanes ac[3];
  // 1, or 0 where the bound of a triangle must not be used.
  Lanes trust;
};

struct TriangleItem {
  Eigen::Vector3d a, b, c;
  int index;
  // Bit i is set if the edge opposite to corner i is a border; bit 3 + i is set if corner i is on a
  // border.
  std::uint8_t border;
};

// The nearest triangle that the search has found so far.
struct Best {
  double squared_distance;
  int item = -1;
  Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

// Computes the exact distance to one triangle and updates `best`. It is not inlined, so that it is
// compiled only once and gives the same result on every machine.
[[gnu::noinline]] void TryTriangle(const TriangleItem* items,
                                   int i,
                                   const Eigen::Vector3d& query,
                                   Best* best) {
  const TriangleItem& item = items[i];
  const Eigen::Vector3d barycentric = ClosestPointOnTriangle(query, item.a, item.b, item.c);
  const Eigen::Vector3d position =
      barycentric[0] * item.a + barycentric[1] * item.b + barycentric[2] * item.c;
  const double distance = (query - position).squaredNorm();
  if (!(distance <= best->squared_distance)) return;
  if (best->item >= 0 && distance == best->squared_distance &&
      item.index > items[best->item].index) {
    return;
  }
  *best = {distance, i, barycentric, position};
}

// One vector in each lane.
struct LaneVector {
  Lanes x, y, z;
};

[[gnu::always_inline]] inline Lanes Dot(const LaneVector& u, const LaneVector& v) {
  return u.x * v.x + u.y * v.y + u.z * v.z;
}

// Returns the squared distance from a point (given relative to the start of an edge) to the edge.
[[gnu::always_inline]] inline Lanes SquaredToEdge(const LaneVector& place,
                                                  const LaneVector& edge,
                                                  const Lanes& projection,
                                                  const Lanes& squared_length) {
  const Lanes ahead = Where(projection > 0.0, projection);
  const Lanes fraction =
      Select(ahead < squared_length, ahead / squared_length, Lanes{1.0, 1.0, 1.0, 1.0});
  const LaneVector gap = {
      place.x - fraction * edge.x, place.y - fraction * edge.y, place.z - fraction * edge.z};
  return Dot(gap, gap);
}

// Returns lower bounds of the squared distances to the triangles, up to kBoundSlack and kBoundRoom.
// If the query lies above a triangle or slightly beside it, the bound is the distance to the plane
// of the triangle; otherwise it is the distance to the nearest edge.
[[gnu::always_inline]] inline Lanes BoundDistances(const TriangleLeaf& leaf,
                                                   const Eigen::Vector3d& query) {
  const LaneVector ab = {leaf.ab[0], leaf.ab[1], leaf.ab[2]};
  const LaneVector ac = {leaf.ac[0], leaf.ac[1], leaf.ac[2]};
  const LaneVector bc = {ac.x - ab.x, ac.y - ab.y, ac.z - ab.z};
  const LaneVector aq = {query[0] - leaf.a[0], query[1] - leaf.a[1], query[2] - leaf.a[2]};
  const LaneVector bq = {aq.x - ab.x, aq.y - ab.y, aq.z - ab.z};
  const LaneVector normal = {
      ab.y * ac.z - ab.z * ac.y, ab.z * ac.x - ab.x * ac.z, ab.x * ac.y - ab.y * ac.x};
  const Lanes b_b = Dot(ab, ab), b_c = Dot(ab, ac), c_c = Dot(ac, ac);
  const Lanes q_b = Dot(aq, ab), q_c = Dot(aq, ac);
  const Lanes n_n = Dot(normal, normal);
  const Lanes to_ab = SquaredToEdge(aq, ab, q_b, b_b);
  const Lanes to_ac = SquaredToEdge(aq, ac, q_c, c_c);
  const Lanes to_bc = SquaredToEdge(bq, bc, Dot(bq, bc), Dot(bc, bc));
  const Lanes to_a = Select(to_ab < to_ac, to_ab, to_ac);
  const Lanes to_edges = Select(to_a < to_bc, to_a, to_bc);
  // v and w are the barycentric coordinates of b and c, multiplied by n_n.
  const Lanes v = c_c * q_b - b_c * q_c;
  const Lanes w = b_b * q_c - b_c * q_b;
  const Lanes least = -kSideRoom * (b_b + c_c) * (b_b + c_c + Dot(aq, aq));
  const LaneMask inside = (v > least) & (w > least) & (n_n - v - w > least);
  const Lanes off = Dot(aq, normal);
  return Where(leaf.trust > 0.0, kBoundSlack * Select(inside, off * off / n_n, to_edges));
}

struct TriangleVisitor {
  const TriangleLeaf* leaves;
  const TriangleItem* items;
  double room;
  const Eigen::Vector3d& query;
  Best* best;

  double bound() const { return best->squared_distance; }
  [[gnu::always_inline]] void Leaf(int leaf) {
    const Lanes bounds = BoundDistances(leaves[leaf], query);
    for (int i = 0; i < kLeafSize; ++i) {
      // The comparison is false for lanes without a triangle, which are not a number.
      if (bounds[i] <= best->squared_distance + room) {
        TryTriangle(items, leaf * kLeafSize + i, query, best);
      }
    }
  }
};

CERES_ED_FOR_EACH_MACHINE
void Search(const BoxTree& tree, TriangleVisitor* visitor) { tree.Visit(visitor->query, visitor); }

}  // namespace

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

  // Builds the tree, and sorts the items by leaf.
  void Build() {
    std::vector<Eigen::Vector3d> centers;
    centers.reserve(items.size());
    for (const TriangleItem& item : items) {
      centers.push_back(0.5 * (item.a.cwiseMin(item.b).cwiseMin(item.c) +
                               item.a.cwiseMax(item.b).cwiseMax(item.c)));
    }
    tree.emplace(centers, kLeafSize);
    std::vector<TriangleItem> sorted;
    sorted.reserve(items.size());
    for (const int i : tree->order()) sorted.push_back(items[i]);
    items.swap(sorted);
    item_of_triangle.assign(cloud.triangles.size(), -1);
    for (std::size_t i = 0; i < items.size(); ++i) {
      item_of_triangle[items[i].index] = static_cast<int>(i);
    }
    std::vector<BoxTree::Box> boxes(tree->num_leaves());
    leaves.resize(tree->num_leaves());
    double largest = 0.0;
    for (std::size_t i = 0; i < leaves.size() * kLeafSize; ++i) {
      TriangleItem none;
      none.a = none.b = none.c =
          Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
      const TriangleItem& item = i < items.size() ? items[i] : none;
      for (const Eigen::Vector3d* corner : {&item.a, &item.b, &item.c}) {
        boxes[i / kLeafSize].Extend(*corner);
      }
      const double widest = SetPlace(item, i % kLeafSize, &leaves[i / kLeafSize]);
      if (widest > largest) largest = widest;
    }
    room = kBoundRoom * largest;
    tree->Fit(boxes);
  }

  // Writes a triangle into a lane of its leaf, and returns the square of its longest edge.
  static double SetPlace(const TriangleItem& item, int place, TriangleLeaf* leaf) {
    const Eigen::Vector3d ab = item.b - item.a;
    const Eigen::Vector3d ac = item.c - item.a;
    for (int axis = 0; axis < 3; ++axis) {
      leaf->a[axis][place] = item.a[axis];
      leaf->ab[axis][place] = ab[axis];
      leaf->ac[axis][place] = ac[axis];
    }
    const double widest =
        std::max({ab.squaredNorm(), ac.squaredNorm(), (item.c - item.b).squaredNorm()});
    const double area = ab.cross(ac).squaredNorm();
    leaf->trust[place] = area <= kBoundFlatness * kBoundFlatness * widest * widest ? 0.0 : 1.0;
    return widest;
  }

  Best Find(const Eigen::Vector3d& query, double squared_bound, int hint) const {
    Best best{squared_bound};
    if (hint >= 0) TryTriangle(items.data(), item_of_triangle[hint], query, &best);
    TriangleVisitor visitor{leaves.data(), items.data(), room, query, &best};
    Search(*tree, &visitor);
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
  // The item of each triangle of the cloud; -1 for triangles that are not in the index.
  std::vector<int> item_of_triangle;
  std::optional<BoxTree> tree;
  // The same triangles as in `items`, four in each leaf.
  std::vector<TriangleLeaf> leaves;
  double room = 0.0;
  // Used only if the cloud has no triangles.
  std::optional<KdTree> point_tree;
  std::vector<char> is_border_point;
};

SurfaceIndex::SurfaceIndex(const PointCloud& cloud, const SurfaceTopology& topology)
    : impl_(std::make_unique<Impl>(cloud)) {
  impl_->CollectTriangles(topology);
  if (impl_->items.empty()) {
    impl_->point_tree.emplace(cloud.points);
    impl_->is_border_point = topology.is_border;
    return;
  }
  impl_->Build();
}

SurfaceIndex::SurfaceIndex(const PointCloud& cloud) : SurfaceIndex(cloud, BuildTopology(cloud)) {}
SurfaceIndex::~SurfaceIndex() = default;
SurfaceIndex::SurfaceIndex(SurfaceIndex&&) noexcept = default;
SurfaceIndex& SurfaceIndex::operator=(SurfaceIndex&&) noexcept = default;

SurfaceHit SurfaceIndex::Closest(const Eigen::Vector3d& query,
                                 double max_distance,
                                 int hint) const {
  if (!(max_distance >= 0.0) || !query.allFinite()) return {};
  if (!impl_->point_tree)
    return impl_->HitOf(impl_->Find(query, max_distance * max_distance, hint));
  const Neighbor nearest = impl_->point_tree->NearestWithin(query, max_distance, hint);
  SurfaceHit hit;
  if (!nearest.found()) return hit;
  hit.position = impl_->cloud.points[nearest.index];
  hit.squared_distance = nearest.squared_distance;
  hit.nearest_vertex = nearest.index;
  hit.on_border = impl_->is_border_point[nearest.index] != 0;
  return hit;
}

}  // namespace ceres_ed
