// Binds deformation graphs, which are built on a surface or made from nodes and edges.
#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/python/arrays.h>
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/errors.h>
#include <ceres_ed/python/graphs.h>
#include <ceres_ed/python/options.h>
#include <ceres_ed/python/pickles.h>
#include <ceres_ed/python/surfaces.h>

#include <algorithm>
#include <optional>
#include <utility>

#include <pybind11/stl.h>

namespace ceres_ed::python {
namespace {

void AddEdges(const py::object& edges, const py::object& weights, DeformationGraph* graph) {
  if (IsNone(edges)) return;
  const auto pairs = py::array::ensure(edges);
  if (!pairs || pairs.ndim() != 2 || pairs.shape(1) != 2) {
    throw py::value_error("edges: expected (E, 2) node indices");
  }
  const std::vector<int> ends = ToIndices(pairs.attr("ravel")(), "edges");
  const std::size_t count = ends.size() / 2;
  std::vector<double> alpha(count, 1.0);
  if (!IsNone(weights)) {
    const auto given = Doubles(weights, "edge_weights");
    if (given.ndim() != 1 || static_cast<std::size_t>(given.size()) != count) {
      throw py::value_error("edge_weights: expected one for each of " + std::to_string(count) +
                            " edges");
    }
    std::copy_n(given.data(), count, alpha.begin());
  }
  for (std::size_t e = 0; e < count; ++e) {
    const GraphEdge edge = {ends[2 * e], ends[2 * e + 1], alpha[e]};
    if (std::max(edge.from, edge.to) >= graph->num_nodes() || edge.from == edge.to) {
      throw py::value_error("edge " + std::to_string(e) + " joins nodes " +
                            std::to_string(edge.from) + " and " + std::to_string(edge.to) +
                            ", expected two of " + std::to_string(graph->num_nodes()) + " nodes");
    }
    if (!(edge.weight >= 0.0)) {
      throw py::value_error("edge " + std::to_string(e) + " has weight " +
                            std::to_string(edge.weight) + ", expected >= 0");
    }
    graph->AddEdge(edge);
  }
}

Graph MakeGraph(const py::object& nodes, const py::object& edges, const py::object& edge_weights) {
  Graph graph;
  for (const Eigen::Vector3d& node : ToPoints(nodes, "nodes")) graph.graph.AddNode(node);
  AddEdges(edges, edge_weights, &graph.graph);
  return graph;
}

Graph Build(const py::object& surface_object,
            const GraphOptions* options,
            const py::kwargs& changes) {
  const SurfaceArgument surface(surface_object, "the surface");
  GraphOptions changed = options != nullptr ? *options : GraphOptions();
  OptionsClass<GraphOptions>::Apply("Graph.build", changes, &changed);
  const auto build = [&] {
    const py::gil_scoped_release release;
    return BuildGraph(*surface, changed);
  };
  BuiltGraph built = ValueOrThrow(build());
  Graph graph;
  graph.graph = std::move(built.graph);
  graph.binding = built.binding;
  graph.node_points = std::move(built.node_points);
  graph.node_spacing = built.node_spacing;
  graph.warnings = std::move(built.warnings);
  return graph;
}

}  // namespace

py::array Nodes(const DeformationGraph& graph) {
  const auto& positions = graph.positions();
  return ReadOnly(OwnedView(std::vector<Eigen::Vector3d>(positions.begin(), positions.end())));
}

py::array Edges(const DeformationGraph& graph) {
  std::vector<std::array<int, 2>> edges;
  for (const GraphEdge& edge : graph.edges()) edges.push_back({edge.from, edge.to});
  const auto [kept, owner] = Keep(std::move(edges));
  return ReadOnly(View(reinterpret_cast<int*>(kept->data()), kept->size(), 2, owner));
}

py::array EdgeWeights(const DeformationGraph& graph) {
  py::array_t<double> weights(graph.num_edges());
  double* weight = weights.mutable_data();
  for (const GraphEdge& edge : graph.edges()) *weight++ = edge.weight;
  return ReadOnly(std::move(weights));
}

BindingOptions ToBinding(int neighbors, const std::string& distance) {
  BindingOptions binding;
  binding.neighbors = neighbors;
  const std::optional<DistanceRule> rule = FindByName<DistanceRule>(distance);
  if (!rule.has_value()) {
    throw py::value_error("distance is '" + distance + "', expected '" +
                          ListNames<DistanceRule>("' or '") + "'");
  }
  binding.distance = *rule;
  std::string error;
  if (!binding.IsValid(&error)) throw py::value_error(error);
  return binding;
}

void BindGraph(py::module_& module) {
  const OptionsClass<GraphOptions> options(
      module, "GraphOptions", "The options of a graph. Lengths are in the unit of the surface.");
  py::class_<Graph> graph(
      module, "Graph", R"(The nodes of a deformation graph and the edges between them.

Arrays are read-only copies, because the library does not keep the nodes in one piece of memory.)");
  graph
      .def(py::init(&MakeGraph),
           py::arg("nodes"),
           py::arg("edges") = py::none(),
           py::arg("edge_weights") = py::none(),
           R"(Takes `nodes` (N, 3), directed `edges` (E, 2) and their weights >= 0 (E,).

Without weights, all are 1.)")
      .def_static("build",
                  &Build,
                  py::arg("surface"),
                  py::arg("options") = nullptr,
                  R"(Returns the graph of a surface.

The options of GraphOptions may be given as keywords, which take precedence over `options`. Raises a
ValueError for a bad option, and for a surface without points or extent.)")
      .def_property_readonly(
          "nodes",
          [](const Graph& self) { return Nodes(self.graph); },
          "The rest positions, (N, 3).")
      .def_property_readonly(
          "edges",
          [](const Graph& self) { return Edges(self.graph); },
          "Directed edges (j, k), (E, 2) int32: node j predicts the motion of node k (Eq. 6).")
      .def_property_readonly(
          "edge_weights",
          [](const Graph& self) { return EdgeWeights(self.graph); },
          "The weights alpha_jk, (E,), without unit.")
      .def_property_readonly(
          "node_points",
          [](const Graph& self) { return self.node_points; },
          "The point of the surface at which each node lies; empty unless the graph was built on "
          "one.")
      .def_readonly(
          "node_spacing", &Graph::node_spacing, "In the unit of the points; 0 if it is not known.")
      .def_readonly("warnings", &Graph::warnings)
      .def("__len__", [](const Graph& self) { return self.graph.num_nodes(); })
      .def("__repr__", [](const Graph& self) {
        return "<ceres_ed.Graph of " + std::to_string(self.graph.num_nodes()) + " nodes, " +
               std::to_string(self.graph.num_edges()) + " edges>";
      });
  AddPickle(&graph);
}

}  // namespace ceres_ed::python
