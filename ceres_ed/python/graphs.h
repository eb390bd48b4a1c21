// The class Graph.
#ifndef CERES_ED_PYTHON_GRAPHS_H_
#define CERES_ED_PYTHON_GRAPHS_H_

#include <ceres_ed/graph/binding.h>
#include <ceres_ed/graph/deformation_graph.h>

#include <string>
#include <vector>

#include <pybind11/numpy.h>

namespace ceres_ed::python {

// Nodes and edges, and the options with which the points of the surface are bound to them.
struct Graph {
  DeformationGraph graph;
  BindingOptions binding;
  // The point at which each node lies; empty if the graph was not built on points.
  std::vector<int> node_points;
  // The node spacing in the unit of the points; 0 if it is not known.
  double node_spacing = 0.0;
  std::vector<std::string> warnings;
};

// Return the nodes (N, 3), the edges (E, 2) and their weights (E,) as read-only copies.
pybind11::array Nodes(const DeformationGraph& graph);
pybind11::array Edges(const DeformationGraph& graph);
pybind11::array EdgeWeights(const DeformationGraph& graph);

// Returns binding options. Raises a ValueError for an unknown name or a bad number.
BindingOptions ToBinding(int neighbors, const std::string& distance);

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_GRAPHS_H_
