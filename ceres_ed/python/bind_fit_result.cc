// Binds the result of a fit.
#include <ceres_ed/python/arrays.h>
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/graphs.h>
#include <ceres_ed/python/pickles.h>
#include <ceres_ed/python/surfaces.h>
#include <ceres_ed/registration/fit.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <pybind11/stl.h>

namespace ceres_ed::python {
namespace {

py::dict Times(const FittedSurface& self) {
  const FitTimes& times = self.result.times;
  py::dict seconds;
  seconds["rigid"] = times.rigid;
  seconds["prepare"] = times.prepare;
  seconds["graph"] = times.graph;
  seconds["associate"] = times.associate;
  seconds["build"] = times.build;
  seconds["solve"] = times.solve;
  seconds["level1"] = times.level1;
  seconds["level2"] = times.level2;
  seconds["finish"] = times.finish;
  return seconds;
}

py::list Terms(const FittedSurface& self) {
  py::list terms;
  for (const TermEnergy& term : self.result.final_energy.terms) {
    py::dict entry;
    entry["name"] = term.label;
    entry["weighted"] = term.weighted;
    entry["raw"] = term.raw;
    entry["residuals"] = term.residuals;
    terms.append(entry);
  }
  return terms;
}

py::list LandmarkErrorsOf(const FittedSurface& self) {
  py::list landmarks;
  for (std::size_t i = 0; i < self.landmark_errors.size(); ++i) {
    py::dict entry;
    entry["name"] = self.landmark_pairs[i].name;
    entry["before"] = self.landmark_errors[i].before;
    entry["rigid"] = self.landmark_errors[i].rigid;
    entry["after"] = self.landmark_errors[i].after;
    landmarks.append(entry);
  }
  return landmarks;
}

Graph GraphOf(const FittedSurface& self) {
  Graph graph;
  graph.graph = self.result.warp.graph;
  graph.binding = self.result.warp.binding;
  return graph;
}

py::array PointRelevant(const py::object& self) {
  std::vector<char>& flags = self.cast<FittedSurface&>().result.point_relevant;
  return ReadOnly(py::array(py::dtype("?"), flags.size(), flags.data(), self));
}

using ResultClass = py::class_<FittedSurface>;

// Adds a number of the result with its docstring.
template <typename Get>
void AddNumber(ResultClass* result, const char* name, Get get, const char* doc) {
  result->def_property_readonly(
      name, [get](const FittedSurface& self) { return get(self.result); }, doc);
}

void BindArrays(ResultClass* result) {
  result
      ->def_property_readonly(
          "points",
          [](const py::object& self) {
            return View(self.cast<FittedSurface&>().result.points, self);
          },
          "The deformed source in the target's frame and unit, (N, 3) float64; a view that "
          "cannot be written.")
      .def_property_readonly(
          "normals",
          [](const py::object& self) -> py::object {
            std::vector<Eigen::Vector3d>& normals = self.cast<FittedSurface&>().result.normals;
            if (normals.empty()) return py::none();
            return View(normals, self);
          },
          "The normals of the deformed source, (N, 3) float64; a view. None if it has none.")
      .def_property_readonly(
          "std_dev",
          [](const FittedSurface& self) -> py::object {
            const std::vector<double> deviations = self.result.uncertainty.StandardDeviations();
            if (deviations.empty()) return py::none();
            return py::array_t<double>(static_cast<py::ssize_t>(deviations.size()),
                                       deviations.data());
          },
          "The standard deviation of each point in the target's unit, the root of the trace of its "
          "covariance, (N,) float64. NaN if nothing determines it. None without covariance=True.")
      .def_property_readonly(
          "covariance",
          [](const py::object& self) -> py::object {
            std::vector<Eigen::Matrix3d>& covariances =
                self.cast<FittedSurface&>().result.uncertainty.covariances;
            if (covariances.empty()) return py::none();
            return ReadOnly(py::array_t<double>(
                {static_cast<py::ssize_t>(covariances.size()), py::ssize_t{3}, py::ssize_t{3}},
                covariances.front().data(),
                self));
          },
          "The covariance of each point in the target's squared unit, (N, 3, 3) float64; a view. "
          "NaN if nothing determines it. None without covariance=True.")
      .def_property_readonly(
          "triangles",
          [](const py::object& self) {
            return ViewOrNone(self.cast<FittedSurface&>().input.source.triangles, self);
          },
          "The triangles of the source, (M, 3) int32; a view. None for bare points.")
      .def_property_readonly(
          "source_points",
          [](const py::object& self) {
            return View(self.cast<FittedSurface&>().input.source.points, self);
          },
          "The points of the source before the fit, (N, 3) float64; a view.")
      .def_property_readonly(
          "colors",
          [](const py::object& self) -> py::object {
            Colors& colors = self.cast<FittedSurface&>().colors;
            if (colors.empty()) return py::none();
            return ColorView(colors, self);
          },
          "Red, green and blue of the source, (N, 3) uint8; a view. None if it has none.")
      .def_property_readonly(
          "warp",
          [](FittedSurface& self) -> Warp& { return self.result.warp; },
          py::return_value_policy::reference_internal,
          "The Warp, which maps any cloud in the source's frame to the target's frame.")
      .def_property_readonly("graph", &GraphOf, "The Graph, in the source's frame and unit.")
      .def_property_readonly(
          "rigid",
          [](const FittedSurface& self) { return ToMatrix(self.result.rigid); },
          "(4, 4) [s R, T; 0 0 0 1], target from source: the rigid placement before the "
          "deformation.")
      .def_property_readonly(
          "point_relevant",
          &PointRelevant,
          "(nodes,) bool: whether an observation depended on the node in the last round.");
}

void BindNumbers(ResultClass* result) {
  using R = FitResult;
  result->def_property_readonly(
      "status",
      [](const FittedSurface& self) { return NameOf(self.result.status); },
      "'converged', 'max_iterations', 'time_limit' or 'interrupted'. After the last two, `points` "
      "are the best result so far.");
  AddNumber(
      result, "message", [](const R& r) { return r.message; }, "A sentence on how the fit ended.");
  AddNumber(
      result,
      "inliers",
      [](const R& r) { return r.matches.inliers; },
      "The number of accepted matches in the last round.");
  AddNumber(
      result,
      "rms_point_to_plane",
      [](const R& r) { return r.matches.rms_plane; },
      "The root mean square point-to-plane distance of the matches, in the target's unit.");
  AddNumber(
      result,
      "rms_point_to_point",
      [](const R& r) { return r.matches.rms_point; },
      "The root mean square point-to-point distance of the matches, in the target's unit.");
  AddNumber(
      result,
      "initial_energy",
      [](const R& r) { return r.initial_energy.Total(); },
      "The objective at the start of the last round, without unit.");
  AddNumber(
      result,
      "final_energy",
      [](const R& r) { return r.final_energy.Total(); },
      "The objective at the end, without unit.");
  result->def_property_readonly(
      "terms",
      &Terms,
      "The parts of final_energy, a dict for each energy: name, weighted, raw, residuals.");
  result->def_property_readonly(
      "landmark_errors",
      &LandmarkErrorsOf,
      "How far landmarks that are named on both surfaces are off, in the target's unit, a dict for "
      "each: name, before, rigid (after the rigid placement), after.");
}

// How the fit went, and what it found out.
void BindCourse(ResultClass* result) {
  using R = FitResult;
  AddNumber(
      result,
      "outer_iterations",
      [](const R& r) { return r.outer_iterations; },
      "The number of rounds of matching and solving.");
  AddNumber(
      result,
      "solver_iterations",
      [](const R& r) { return r.solver_iterations; },
      "The number of iterations of the solver in all rounds.");
  AddNumber(
      result,
      "max_fixed_error",
      [](const R& r) { return r.max_fixed_error; },
      "The largest distance of a fixed point from its position, in the target's unit.");
  AddNumber(
      result,
      "rigid_only",
      [](const R& r) { return r.rigid_only; },
      "Whether the deformation was discarded because it explained less than the rigid placement.");
  AddNumber(
      result,
      "hypothesis",
      [](const R& r) { return r.hypothesis; },
      "The name of the hypothesis that the fit went on with; empty if there was only one graph.");
  AddNumber(
      result,
      "noise",
      [](const R& r) { return r.noise; },
      "The standard deviation of the target's noise, in its unit.");
  AddNumber(
      result,
      "unfolded",
      [](const R& r) { return r.unfolded; },
      "The number of faces that were folded over and have been laid flat.");
  AddNumber(
      result, "warnings", [](const R& r) { return r.warnings; }, "The warnings, a sentence each.");
  result->def_property_readonly("times", &Times, "The seconds of each stage.");
  result->def_readonly("verdict",
                       &FittedSurface::verdict,
                       "The Verdict: whether the result can be trusted, and why.");
  result->def_property_readonly(
      "checks",
      [](const FittedSurface& self) { return self.checks; },
      "What is wrong with the inputs, a Finding for each fault.");
  result->def("__len__", [](const FittedSurface& self) { return self.result.points.size(); });
  result->def("__repr__", [](const FittedSurface& self) {
    return "<ceres_ed.FitResult of " + std::to_string(self.result.points.size()) + " points, " +
           std::to_string(self.result.warp.graph.num_nodes()) +
           " nodes: " + NameOf(self.result.status) + ">";
  });
}

}  // namespace

void BindFitResult(py::module_& module) {
  ResultClass result(module, "FitResult", R"(The result of a fit.

Arrays of points are views of the result's own memory and keep it alive.)");
  BindArrays(&result);
  BindNumbers(&result);
  BindCourse(&result);
  AddPickle(&result);
}

}  // namespace ceres_ed::python
