#include "ceres_ed/slam/frame/map_growth.h"

#include <ceres_ed/geometry/nearest_pixel.h>
#include <ceres_ed/graph/binding.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ceres_ed {
namespace {

// Longer edges are not added, unless a node would have fewer than kFewestEdges.
constexpr double kLongestEdge = 2.5;
constexpr int kFewestEdges = 3;
// A point farther than this from the observed surface does not belong to it, in map units.
constexpr double kFarFromSurface = 1.0;

// A patch that the map lacks.
struct Candidate {
  Eigen::Vector3d in_camera;
  Eigen::Vector3d in_map;
  Eigen::Vector3d normal_in_map;
  std::array<std::uint8_t, 3> color;
};

// Marks discs of pixels as covered, in cells of the observed surface.
class Coverage {
 public:
  Coverage(const ObservedSurface& surface, double spacing)
      : surface_(surface), spacing_(spacing), covered_(surface.width(), surface.height(), 0) {}

  bool Covers(int i, int j) const { return covered_(i, j) != 0; }

  // Returns the share of the valid patches that are covered.
  double ShareOfSurface() const {
    int covered = 0;
    for (int j = 0; j < surface_.height(); ++j) {
      for (int i = 0; i < surface_.width(); ++i) {
        if (Covers(i, j) && surface_.patch(i, j).valid()) ++covered;
      }
    }
    return covered / std::max(1.0, static_cast<double>(surface_.num_valid()));
  }

  void Add(const Eigen::Vector2d& pixel, double z) {
    const double cell = surface_.cell();
    const double radius =
        spacing_ * std::max(surface_.camera().fx, surface_.camera().fy) / z / cell;
    // The middle of a cell, in whole pixels.
    const int middle = surface_.cell() / 2;
    const double ci = (pixel.x() - middle) / cell;
    const double cj = (pixel.y() - middle) / cell;
    const int i_end = std::min(covered_.width() - 1, static_cast<int>(std::floor(ci + radius)));
    const int j_end = std::min(covered_.height() - 1, static_cast<int>(std::floor(cj + radius)));
    for (int j = std::max(0, static_cast<int>(std::ceil(cj - radius))); j <= j_end; ++j) {
      for (int i = std::max(0, static_cast<int>(std::ceil(ci - radius))); i <= i_end; ++i) {
        if ((i - ci) * (i - ci) + (j - cj) * (j - cj) <= radius * radius) covered_(i, j) = 1;
      }
    }
  }

 private:
  const ObservedSurface& surface_;
  double spacing_;
  Image<std::uint8_t> covered_;
};

std::vector<Candidate> FindCandidates(const std::vector<VisiblePoint>& visible,
                                      const ObservedSurface& surface,
                                      ColorView color,
                                      const MapGrowthOptions& options,
                                      const CameraPose& camera_from_map,
                                      double* explained) {
  Coverage coverage(surface, options.point_spacing);
  for (const VisiblePoint& point : visible) {
    // A point far from the observed surface says nothing about what is there: something else hides
    // it, or it is not tissue.
    const SurfacePatch* patch = surface.Find(point.pixel);
    if (patch != nullptr &&
        std::abs(patch->normal.dot(point.in_camera - patch->point)) > kFarFromSurface) {
      continue;
    }
    coverage.Add(point.pixel, point.in_camera.z());
  }
  *explained = coverage.ShareOfSurface();
  const double min_cosine = std::cos(options.max_view_angle_deg * M_PI / 180.0);
  const Eigen::Quaterniond map_from_camera = camera_from_map.rotation.conjugate();
  std::vector<Candidate> candidates;
  for (int j = 0; j < surface.height(); ++j) {
    for (int i = 0; i < surface.width(); ++i) {
      const SurfacePatch& patch = surface.patch(i, j);
      if (!patch.valid() || coverage.Covers(i, j)) continue;
      if (-patch.normal.dot(patch.point) < min_cosine * patch.point.norm()) continue;
      const Eigen::Vector2d pixel = surface.camera().Project(patch.point);
      coverage.Add(pixel, patch.point.z());
      Candidate candidate;
      candidate.in_camera = patch.point;
      candidate.in_map = camera_from_map.ApplyInverse(patch.point);
      candidate.normal_in_map = map_from_camera * patch.normal;
      candidate.color = color.empty() ? MapPoint().color
                                      : color(NearestPixel(pixel.x()), NearestPixel(pixel.y()));
      candidates.push_back(candidate);
    }
  }
  return candidates;
}

void AddNodeAt(const Eigen::Vector3d& place,
               const MapGrowthOptions& options,
               PlaceBinder* binder,
               DeformableMap* map) {
  LocalWarp warp;
  std::vector<int> partners;
  if (!binder->empty()) {
    partners = binder->Nearest(place, options.edges_per_node);
    // The node starts without strain. If new tissue inherited the strain of its neighbours, this
    // strain would become part of its rest shape and would accumulate from node to node as the map
    // grows.
    warp = map->RigidWarpOf(binder->Bind(place, map->neighbors()));
  }
  const int node = map->AddNode(warp.AtRest(place), place, warp.gradient);
  for (int k = 0; k < static_cast<int>(partners.size()); ++k) {
    const double length = (map->NodePosition(partners[k]) - place).norm();
    if (k >= kFewestEdges && length > kLongestEdge) break;
    map->Connect(node, partners[k]);
  }
  binder->AddNode(*map, node);
}

// Binds the point at `place` and sets its rest position so that it is there now. Returns false if
// the warp of the nodes cannot be inverted.
bool PlacePoint(const DeformableMap& map,
                const Binding& binding,
                const Eigen::Vector3d& place,
                const Eigen::Vector3d& normal,
                MapPoint* point) {
  const LocalWarp warp = map.WarpOf(binding);
  if (!warp.IsInvertible()) return false;
  point->position = warp.AtRest(place);
  // Normals are transformed by the cofactors of the gradient G, which is G^-T up to length; the
  // inverse is G^T.
  point->normal = (warp.gradient.transpose() * normal).normalized();
  return true;
}

// Returns whether one of some places is nearer to a point than a node to which it is bound.
bool IsNearest(const std::vector<Eigen::Vector3d>& places,
               const VisiblePoint& seen,
               const DeformableMap& map) {
  const PointBinding bound = map.binding(seen.slot);
  if (bound.size < map.neighbors()) return true;
  double farthest = 0.0;
  for (int k = 0; k < bound.size; ++k) {
    farthest = std::max(farthest, (map.NodePosition(bound.nodes[k]) - seen.in_map).squaredNorm());
  }
  return std::any_of(places.begin(), places.end(), [&](const Eigen::Vector3d& place) {
    return (place - seen.in_map).squaredNorm() < farthest;
  });
}

// Binds points near new nodes again, because they were bound before the new nodes existed.
void RebindNear(int first_new_node,
                const std::vector<VisiblePoint>& visible,
                PlaceBinder* binder,
                DeformableMap* map) {
  std::vector<Eigen::Vector3d> new_nodes;
  for (int node = first_new_node; node < map->graph().num_nodes(); ++node) {
    new_nodes.push_back(map->NodePosition(node));
  }
  for (const VisiblePoint& seen : visible) {
    // Most points are far from all new nodes.
    if (!IsNearest(new_nodes, seen, *map)) continue;
    const PointBinding fresh = MapPoints::Kept(binder->Bind(seen.in_map, map->neighbors()));
    const bool touches_new = std::any_of(
        fresh.nodes, fresh.nodes + fresh.size, [&](int node) { return node >= first_new_node; });
    if (!touches_new) continue;
    MapPoint moved = map->point(seen.slot);
    if (!PlacePoint(*map, fresh, seen.in_map, seen.normal_in_map, &moved)) continue;
    map->Rebind(seen.slot, fresh);
    map->SetPoint(seen.slot, moved);
  }
}

}  // namespace

PlaceBinder::PlaceBinder(const DeformableMap& map,
                         const CameraPose& camera_from_map,
                         const PinholeCamera& camera) {
  for (const int node : map.NodesNearView(ViewVolume(camera_from_map, camera))) AddNode(map, node);
}

void PlaceBinder::AddNode(const DeformableMap& map, int node) {
  nodes_.push_back(node);
  positions_.push_back(map.NodePosition(node));
}

double PlaceBinder::DistanceTo(const Eigen::Vector3d& place) const {
  double squared = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& p : positions_)
    squared = std::min(squared, (p - place).squaredNorm());
  return std::sqrt(squared);
}

std::vector<int> PlaceBinder::Nearest(const Eigen::Vector3d& place, int count) const {
  std::vector<std::pair<double, int>> order;
  order.reserve(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    order.emplace_back((positions_[i] - place).squaredNorm(), nodes_[i]);
  }
  const std::size_t kept = std::min<std::size_t>(count, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept), order.end());
  std::vector<int> nearest(kept);
  for (std::size_t i = 0; i < kept; ++i) nearest[i] = order[i].second;
  return nearest;
}

Binding PlaceBinder::Bind(const Eigen::Vector3d& place, int neighbors) {
  // Insertion into a short sorted list; this is the innermost loop of the map growth.
  double squared[kMaxBoundNodes + 1];
  int index[kMaxBoundNodes + 1];
  int count = 0;
  const int wanted = neighbors + 1;
  for (int i = 0; i < static_cast<int>(positions_.size()); ++i) {
    const double d = (positions_[i] - place).squaredNorm();
    if (count == wanted && d >= squared[count - 1]) continue;
    int k = count < wanted ? count++ : count - 1;
    for (; k > 0 && squared[k - 1] > d; --k) {
      squared[k] = squared[k - 1];
      index[k] = index[k - 1];
    }
    squared[k] = d;
    index[k] = i;
  }
  for (int k = 0; k < count; ++k) squared[k] = std::sqrt(squared[k]);
  Binding binding;
  binding.size = ComputeWeights(squared, count, neighbors, weights_);
  for (int k = 0; k < binding.size; ++k) bound_nodes_[k] = nodes_[index[k]];
  binding.nodes = bound_nodes_;
  binding.weights = weights_;
  return binding;
}

MapGrowthResult GrowMap(const std::vector<VisiblePoint>& visible,
                        const ObservedSurface& surface,
                        ColorView color,
                        int frame,
                        const MapGrowthOptions& options,
                        DeformableMap* map) {
  MapGrowthResult result;
  const CameraPose camera_from_map = map->state().camera_from_map;
  const std::vector<Candidate> candidates =
      FindCandidates(visible, surface, color, options, camera_from_map, &result.explained);
  if (candidates.empty()) return result;
  PlaceBinder binder(*map, camera_from_map, surface.camera());
  const int first_new_node = map->graph().num_nodes();
  // First nodes are added where no node is near enough, then the points are bound to the nodes.
  for (const Candidate& candidate : candidates) {
    if (binder.DistanceTo(candidate.in_map) <= options.node_coverage) continue;
    AddNodeAt(candidate.in_map, options, &binder, map);
  }
  result.new_nodes = map->graph().num_nodes() - first_new_node;
  if (result.new_nodes > 0) RebindNear(first_new_node, visible, &binder, map);
  for (const Candidate& candidate : candidates) {
    const PointBinding binding = MapPoints::Kept(binder.Bind(candidate.in_map, map->neighbors()));
    MapPoint point;
    if (!PlacePoint(*map, binding, candidate.in_map, candidate.normal_in_map, &point)) continue;
    point.weight = 1.0;
    point.color = candidate.color;
    point.birth_frame = frame;
    point.last_seen = frame;
    point.birth_position = candidate.in_camera;
    map->AddPoint(point, binding);
    ++result.new_points;
  }
  return result;
}

}  // namespace ceres_ed
