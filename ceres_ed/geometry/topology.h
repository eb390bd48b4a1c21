// How the points of a mesh hang together.
#ifndef CERES_ED_GEOMETRY_TOPOLOGY_H_
#define CERES_ED_GEOMETRY_TOPOLOGY_H_

#include <ceres_ed/geometry/point_cloud.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A way from one point to another over the surface.
struct SurfaceLink {
  int to = -1;
  // In the unit of the points.
  double length = 0.0;
};

// The links of one point: a range for `for (const SurfaceLink& link : ...)`.
struct SurfaceLinks {
  const SurfaceLink* first = nullptr;
  const SurfaceLink* last = nullptr;

  const SurfaceLink* begin() const { return first; }
  const SurfaceLink* end() const { return last; }
  int size() const { return static_cast<int>(last - first); }
};

// Connectivity with points at the same position (to the bit) welded, so that a mesh whose triangles
// share no vertices (STL and the like) behaves as the welded one. All links join representatives; a
// point that is not its own representative has none. Nothing here depends on the order of the
// points, except which of several welded points represents them (the lowest index).
struct SurfaceTopology {
  // For every point the lowest index of those at its position.
  std::vector<int> representative;
  // The representatives by x, then y, then z: an order that does not depend on the file's.
  std::vector<int> walk_order;

  // Mesh edges of point p: edges[edge_offsets[p]] to edges[edge_offsets[p + 1]], by `to`.
  std::vector<int> edge_offsets;
  std::vector<SurfaceLink> edges;
  // For every element of `edges`: does only one triangle have it?
  std::vector<char> edge_is_border;

  // What along-surface distances walk: the mesh edges, and for each edge of two triangles the
  // straight line between their opposite corners with the two unfolded into a plane (where that
  // line crosses the edge). The lines cut the worst detour on a regular mesh from 15 % to 4 %.
  std::vector<int> path_offsets;
  std::vector<SurfaceLink> paths;

  // 1 for points on a border edge.
  std::vector<char> is_border;
  // 1 for points in no triangle (of three different positions); all of a bare cloud.
  std::vector<char> is_isolated;
  // The component of every point, numbered by lowest point; an isolated position is one of its own.
  std::vector<int> component;
  // The number of positions (welded points count once) of every component.
  std::vector<int> component_sizes;

  int num_points() const { return static_cast<int>(representative.size()); }
  int num_components() const { return static_cast<int>(component_sizes.size()); }
  bool HasSurface() const { return !edges.empty(); }
  SurfaceLinks Edges(int point) const {
    return {edges.data() + edge_offsets[point], edges.data() + edge_offsets[point + 1]};
  }
  SurfaceLinks Paths(int point) const {
    return {paths.data() + path_offsets[point], paths.data() + path_offsets[point + 1]};
  }
  // Whether the edge between two points (or their representatives) is there and is a border.
  bool IsBorderEdge(int point, int other) const;
};

// The topology of `cloud`. CHECK-fails on a triangle index that is out of range.
SurfaceTopology BuildTopology(const PointCloud& cloud);

// For every point the lowest index of those at the same position, to the bit (0 and -0 are one).
// Where `walk_order` is given it gets the representatives by x, then y, then z.
std::vector<int> WeldPoints(const std::vector<Eigen::Vector3d>& points,
                            std::vector<int>* walk_order = nullptr);

// The mean length of the mesh edges in the unit of the points; 0 where there are none.
double MeanEdgeLength(const SurfaceTopology& topology);

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_TOPOLOGY_H_
