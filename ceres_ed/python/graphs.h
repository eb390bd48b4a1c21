// The class Graph.
#ifndef CERES_ED_PYTHON_GRAPHS_H_
#define CERES_ED_PYTHON_GRAPHS_H_

#include <ceres_ed/graph/binding.h>
#include <ceres_ed/graph/deformation_graph.h>

#include <string>
#include <vector>

#include <pybind11/numpy.h>

namespace ceres_ed::python {

// Nodes and edges, and how the points that they were built on are bound to them.
struct Graph {
  DeformationGraph graph;
  BindingOptions binding;
  // The point that each node sits on; empty where it was not built on points.
  std::vector<int> node_points;
  // Unit of the points; 0 where it isn't known.
  double node_spacing = 0.0;
  std::vector<std::string> warnings;
};

// Nodes (N, 3), edges (E, 2) and their weights (E,), to look at.
pybind11::array Nodes(const DeformationGraph& graph);
pybind11::array Edges(const DeformationGraph& graph);
pybind11::array EdgeWeights(const DeformationGraph& graph);

// What is said of binding; ValueError on another word or number.
BindingOptions ToBinding(int neighbors, const std::string& distance);

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_GRAPHS_H_
