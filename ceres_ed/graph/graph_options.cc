#include "ceres_ed/graph/graph_options.h"

#include <ceres_ed/util/options.h>

#include <algorithm>
#include <thread>

#include <cost_functions/node_parameters.h>

namespace ceres_ed {

const OptionTable<BindingOptions>& BindingOptions::Rows() {
  using O = BindingOptions;
  static const OptionTable<O> rows({
      Row(&O::neighbors, "neighbors", "The number of nodes that move a point.")
          .In(Between(1, kMaxBoundNodes)),
      Row(&O::distance, "distance", "How far a point is from a node: along the surface or not."),
      Row(&O::num_threads, "threads", "The result does not depend on it.").In(AtLeast(1)),
  });
  return rows;
}

bool BindingOptions::IsValid(std::string* error) const { return Rows().Check(*this, error); }

const OptionTable<GraphOptions>& GraphOptions::Rows() {
  using O = GraphOptions;
  static const OptionTable<O> rows({
      Row(&O::sampling,
          "sampling",
          "How nodes are chosen among the points; farthest is more even and slower."),
      Row(&O::distance,
          "distance",
          "How far a point is from a node: along the surface, or straight through space."),
      Row(&O::node_spacing, "node_spacing", "The distance between nodes.")
          .In(AtLeast(0))
          .Unit("source units")
          .Special(0, "automatic")
          .Main(),
      Row(&O::target_nodes, "target_nodes", "The number of nodes wanted if node_spacing is 0.")
          .In(AtLeast(0))
          .Special(0, "automatic"),
      Row(&O::auto_spacing,
          "auto_spacing",
          "The distance between nodes if nothing else gives it, as a part of the diagonal.")
          .In(Above(0)),
      Row(&O::neighbors, "neighbors", "The number of nodes that move a point.")
          .In(Between(1, kMaxBoundNodes)),
      Row(&O::edges, "edges", "Which nodes share an edge."),
      Row(&O::edges_per_node, "edges_per_node", "The partners that a node keeps.").In(AtLeast(1)),
      Row(&O::min_component_points,
          "min_component_points",
          "Pieces of a mesh with fewer points have no nodes and follow the nodes nearby.")
          .In(AtLeast(1)),
      Row(&O::join_pieces, "join_pieces", "Join the pieces of the graph: none stays behind."),
      Row(&O::edges_per_joint, "edges_per_joint", "The edges at each joint of two pieces.")
          .In(AtLeast(1)),
      Row(&O::num_threads, "threads", "The result does not depend on it.")
          .In(AtLeast(1))
          .Special(0, std::max(1u, std::thread::hardware_concurrency()), "auto"),
      NotData(&O::volume),
      NotData(&O::volume_weight),
      NotData(&O::should_stop),
  });
  return rows;
}

bool GraphOptions::IsValid(std::string* error) const { return Rows().Check(*this, error); }

}  // namespace ceres_ed
