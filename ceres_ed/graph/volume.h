// The nodes and edges inside a closed surface, by which the far side of a body follows the near
// one.
#ifndef CERES_ED_GRAPH_VOLUME_H_
#define CERES_ED_GRAPH_VOLUME_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/topology.h>
#include <ceres_ed/graph/deformation_graph.h>

#include <vector>

namespace ceres_ed {

// Returns whether `cloud` is a mesh without borders, apart from small holes: the square of the
// length of all borders is less than a twentieth of the area. The border of half a ball is that of
// a view, and its square is six times the area.
bool EnclosesBody(const PointCloud& cloud, const SurfaceTopology& topology);

// Fills the body within the closed surface `cloud`. `graph` has nodes at the points `node_points`
// of the surface, about `spacing` > 0 apart in the unit of the points.
//
// Inner nodes are added on a cubic grid, one spacing apart (more if the nodes of the surface are on
// average more than two spacings apart, as those of a coarse mesh may be), as far as they are
// inside and no nearer than 0.8 spacings to a node of the surface. Edges (in both directions, all
// of the weight `weight`
// >= 0) join inner nodes with all nodes within 1.5 spacings. Edges of the weight 1 join nodes of
// the surface that face each other through the body, at most two spacings apart, as in a limb that
// has no room for inner nodes. No edge leaves the body. Returns the number of edges that were
// added; it is 0 if the surface encloses nothing.
int AddVolume(const PointCloud& cloud,
              const std::vector<int>& node_points,
              double spacing,
              double weight,
              DeformationGraph* graph);

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_VOLUME_H_
