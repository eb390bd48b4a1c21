// Binds deformations, which can be loaded, made, read, changed and applied.
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/io/warp_io.h>
#include <ceres_ed/preflight/repair.h>
#include <ceres_ed/python/arrays.h>
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/errors.h>
#include <ceres_ed/python/graphs.h>
#include <ceres_ed/python/options.h>
#include <ceres_ed/python/pickles.h>
#include <ceres_ed/python/surfaces.h>

#include <utility>

#include <cost_functions/node_parameters.h>

namespace ceres_ed::python {
namespace {

using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Warp MakeWarp(const Graph& graph, const py::object& neighbors, const py::object& distance) {
  Warp warp;
  warp.graph = graph.graph;
  warp.state.Resize(graph.graph.num_nodes());
  warp.binding =
      ToBinding(neighbors.is_none() ? graph.binding.neighbors : neighbors.cast<int>(),
                distance.is_none() ? NameOf(graph.binding.distance) : distance.cast<std::string>());
  return warp;
}

py::array Affine(const Warp& warp) {
  py::array_t<double> affine({warp.state.num_nodes(), 3, 3});
  for (int j = 0; j < warp.state.num_nodes(); ++j) {
    Eigen::Map<RowMajor3d>(affine.mutable_data(j)) = NodeAffine(warp.state.node(j));
  }
  return ReadOnly(std::move(affine));
}

void SetAffine(Warp& warp, const py::object& object) {
  const auto affine = Doubles(object, "affine");
  const int nodes = warp.state.num_nodes();
  if (affine.ndim() != 3 || affine.shape(0) != nodes || affine.shape(1) != 3 ||
      affine.shape(2) != 3) {
    throw py::value_error("affine: expected shape (" + std::to_string(nodes) + ", 3, 3)");
  }
  if (!Eigen::Map<const Eigen::VectorXd>(affine.data(), affine.size()).allFinite()) {
    throw py::value_error("affine: expected finite numbers");
  }
  for (int j = 0; j < nodes; ++j) {
    MutableNodeAffine(warp.state.node(j)) = Eigen::Map<const RowMajor3d>(affine.data(j));
  }
}

py::array Translation(const Warp& warp) {
  std::vector<Eigen::Vector3d> translations;
  translations.reserve(warp.state.num_nodes());
  for (int j = 0; j < warp.state.num_nodes(); ++j) {
    translations.emplace_back(NodeTranslation(warp.state.node(j)));
  }
  return ReadOnly(OwnedView(std::move(translations)));
}

void SetTranslation(Warp& warp, const py::object& object) {
  const std::vector<Eigen::Vector3d> translations = ToPoints(object, "translation");
  const auto nodes = static_cast<std::size_t>(warp.state.num_nodes());
  if (translations.size() != nodes) {
    throw py::value_error("translation: expected shape (" + std::to_string(nodes) + ", 3)");
  }
  for (std::size_t j = 0; j < nodes; ++j) {
    MutableNodeTranslation(warp.state.node(static_cast<int>(j))) = translations[j];
  }
}

// Returns the number of threads, which has the words and messages of the option.
int ToThreads(const py::object& threads) {
  GraphOptions options;
  py::cast(&options, py::return_value_policy::reference).attr("threads") = threads;
  std::string error;
  if (!options.IsValid(&error)) throw py::value_error(error);
  return options.num_threads;
}

py::object Apply(const Warp& warp,
                 const py::object& points,
                 const py::object& normals,
                 const py::object& threads_object) {
  PointCloud cloud = SurfaceArgument(points, "points").Take();
  cloud.normals.clear();
  if (!normals.is_none()) cloud.normals = ToNormals(normals, cloud.size(), "normals");
  const int threads = ToThreads(threads_object);
  const auto apply = [&] {
    const py::gil_scoped_release release;
    if (warp.repaired) RepairCloud("points", &cloud);
    return ApplyWarp(warp, &cloud, threads);
  };
  ThrowUnlessOk(apply());
  py::array warped = OwnedView(std::move(cloud.points));
  if (normals.is_none()) return warped;
  return py::make_tuple(warped, OwnedView(std::move(cloud.normals)));
}

Warp LoadWarp(const py::object& path_object) {
  const std::string path = ToPath(path_object);
  CheckReadable(path);
  return ValueOrThrow(ReadWarp(path));
}

Graph GraphOf(const Warp& warp) {
  Graph graph;
  graph.graph = warp.graph;
  graph.binding = warp.binding;
  return graph;
}

// The parts of which a warp is made.
void BindParts(py::class_<Warp>* warp) {
  (*warp)
      .def_property_readonly("graph", &GraphOf, "The Graph, in the source's frame and unit.")
      .def_property_readonly(
          "nodes",
          [](const Warp& self) { return Nodes(self.graph); },
          "The rest positions g_j, (N, 3).")
      .def_property("affine", &Affine, &SetAffine, "A_j, (N, 3, 3).")
      .def_property(
          "translation", &Translation, &SetTranslation, "t_j, (N, 3), in the source's unit.")
      .def_property(
          "target_from_source",
          [](const Warp& self) { return ToMatrix(self.target_from_source); },
          [](Warp& self, const py::object& matrix) {
            self.target_from_source = ToSimilarity(matrix, "target_from_source", true);
          },
          "(4, 4) [s R, T; 0 0 0 1].")
      .def_property_readonly(
          "neighbors",
          [](const Warp& self) { return self.binding.neighbors; },
          "The largest number of nodes to which a point is bound.")
      .def_property_readonly(
          "distance",
          [](const Warp& self) { return NameOf(self.binding.distance); },
          "'surface' or 'euclidean': how the distances to nodes are measured.")
      .def_property_readonly(
          "finish_points",
          [](const py::object& self) { return ViewOrNone(self.cast<Warp&>().finish.points, self); },
          "The points at which f is given, (P, 3); a view. None without a finish.")
      .def_property_readonly(
          "finish_displacements",
          [](const py::object& self) {
            return ViewOrNone(self.cast<Warp&>().finish.displacements, self);
          },
          "f at these points, (P, 3), in the source's unit; a view. None without a finish.");
}

}  // namespace

void BindWarp(py::module_& module) {
  py::class_<Warp> warp(
      module, "Warp", R"(A deformation, complete enough to be applied to any cloud:

  v~ = s R (sum_j w_j(v) [A_j (v - g_j) + g_j + t_j] + f(v)) + T

Here s, R, T are target_from_source, and f is the displacement that the finish of a fit adds. Arrays
of nodes are read-only copies. To change one, assign a new array:
`warp.translation = warp.translation + [0, 0, 1]`.)");
  warp.def(py::init(&MakeWarp),
           py::arg("graph"),
           py::kw_only(),
           py::arg("neighbors") = py::none(),
           py::arg("distance") = py::none(),
           R"(Makes a warp that leaves all nodes of `graph` at rest.

`neighbors` (1 to 8) and `distance` ('surface' or 'euclidean') say how points are bound to nodes.
None means the values with which the graph was built.)")
      .def_static("load",
                  &LoadWarp,
                  py::arg("path"),
                  R"(Returns the warp in a file that save() or ed_fit --warp has written.

Raises an OSError if the file can't be read, and a ValueError that names the field if it is not
such a file.)")
      .def(
          "save",
          [](const Warp& self, const py::object& path) {
            ThrowUnlessWritten(WriteWarp(ToPath(path), self));
          },
          py::arg("path"),
          "Writes a JSON file for load() and ed_apply, completely or not at all. Numbers are read "
          "back with the same bits.")
      .def("apply",
           &Apply,
           py::arg("points"),
           py::arg("normals") = py::none(),
           py::kw_only(),
           py::arg("threads") = py::int_(1),
           R"(Returns points of the source's frame, deformed, in the target's frame, (N, 3).

`points` is any surface. If it has triangles and `distance` is 'surface', distances to nodes are
measured along the triangles. With `normals` (N, 3) it returns a pair (points, normals). `threads`
is a number, or 'auto' for all of the machine.)")
      .def("__len__", [](const Warp& self) { return self.graph.num_nodes(); })
      .def("__repr__", [](const Warp& self) {
        return "<ceres_ed.Warp of " + std::to_string(self.graph.num_nodes()) + " nodes" +
               (self.finish.empty() ? ">" : " and a finish>");
      });
  BindParts(&warp);
  AddPickle(&warp);
}

}  // namespace ceres_ed::python
